// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/types/area_limits.hpp"
#include "core/types/map_correction.hpp"
#include "core/types/result.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/threads/team_hand_over.hpp"

namespace topo::daemon {

/// Bounds on what may be drawn: the velocity gate looks at every edge in each of its periods.
struct AreaCaps {
  std::size_t areas = 16;     ///< stairs, glass and cordons of a building
  std::size_t corners = 240;  ///< of all areas together
};

/// An area that no wheel may enter, or whose goals come first; corners in the map frame of this robot,
/// metres.
struct DrawnArea {
  std::uint64_t number = 0;  ///< of this robot's operators; 0: a mate's
  team::EntryId entry{};     ///< of a mate's, in the team's log
  types::Polygon corners_map;
  types::AreaKind kind = types::AreaKind::kKeepOut;
};

/// The drawn areas that are in force on this robot: its operators' own and those of its mates. A value.
class AreaBook {
 public:
  explicit AreaBook(const AreaCaps& caps = {}) : caps_(caps) {}

  /// A new own area; its id. kInvalidInput: no simple polygon; kBusy: there are enough.
  types::Result<std::string> draw(const types::Polygon& corners_map,
                                  types::AreaKind kind = types::AreaKind::kKeepOut);
  /// kNotFound: no area has this id.
  types::Status withdraw(std::string_view id);
  /// Takes what the team's log says. True when an area came, went or moved.
  bool note(const TeamAreas& team);

  /// The map was corrected: own areas move with it, each as a whole. True when there are any. Mates' areas
  /// come from the team's log, placed by where their maps lie.
  bool move(const types::MapCorrection& correction);

  [[nodiscard]] const std::vector<DrawnArea>& areas() const { return areas_; }
  [[nodiscard]] types::AreaLimits with(const types::AreaLimits& configured) const;
  /// Those whose goals come first.
  [[nodiscard]] std::vector<types::Polygon> here_first() const;
  [[nodiscard]] AreaWishes wishes() const;
  /// What of the mates' areas is not in force here, and why; empty: all is.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

  /// {"areas": [{"id": "1", "kind": "keep_out", "robot": null,
  /// "corners_m": [[x, y], ...]}, ...]}; robot: whose operator drew it, null for this one's.
  [[nodiscard]] Json json() const;
  /// All of it as a file, and back. kInvalidInput says what is wrong; nothing of it counts then.
  [[nodiscard]] std::string text() const;
  static types::Result<AreaBook> parse(std::string_view text, const AreaCaps& caps = {});

 private:
  [[nodiscard]] bool fits(const types::Polygon& more) const;
  bool take(const TeamAreas::OfMate& area, const types::Polygon& corners_map);

  AreaCaps caps_;
  std::vector<DrawnArea> areas_;
  std::vector<team::EntryId> withdrawn_;  ///< of mates, until the team's log says so too
  std::uint64_t last_ = 0;                ///< number of the newest own area
  std::string trouble_;
};

/// [[x, y], ...].
Json corners_json(const types::Polygon& corners);

/// "7", or of a mate's "ROBOT.RUN.NUMBER".
std::string id_of(const DrawnArea& area);

}  // namespace topo::daemon

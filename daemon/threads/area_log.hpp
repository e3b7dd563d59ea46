// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/team/exchange/exchange.hpp"
#include "core/team/exchange/log_areas.hpp"
#include "daemon/threads/team_hand_over.hpp"

namespace topo::daemon {

/// How far a mate's map frame, or an own area with a correction of the map, may move before the areas are
/// placed anew: maps bend a little all the time.
struct AreaPlaceParams {
  double moved_m = 0.02;
  double moved_rad = 0.001;  ///< 2 cm at the far end of a floor
};

/// The areas that a team keeps out of or goes to first, between the operator's wishes on main and the team's
/// log. One thread.
class AreaLog {
 public:
  explicit AreaLog(const AreaPlaceParams& params = {}) : params_(params) {}

  /// The exchange began anew under another run: entries of this robot are made again, and all mates' frames
  /// are those of another map.
  void begin_map();
  void want(const AreaWishes& wishes);
  /// What is new in the log.
  void note(const std::vector<team::LogEntry>& entries);
  /// Where the map of a mate's run lies in this robot's.
  void place(const slam::Origin& origin, const types::Se2& T_map_mates);

  /// Makes the log say what is wished, when anything has changed. True when report() may be another one.
  bool settle(team::Exchange& exchange);
  [[nodiscard]] TeamAreas report() const;

 private:
  /// An own area as the log has it.
  struct Logged {
    team::EntryId id;
    types::Polygon drawn_map;    ///< as it was first said in this run
    types::Polygon corners_map;  ///< as it was last said
  };
  void say(team::Exchange& exchange, const AreaWishes::Own& area);
  /// Is this area, of another run of this robot, one that it has said in the present run?
  [[nodiscard]] bool is_said_again(const team::TeamArea& area) const;
  void withdraw(team::Exchange& exchange, const team::EntryId& id);

  AreaPlaceParams params_;
  AreaWishes wishes_;
  std::map<std::uint64_t, Logged> own_;  ///< entries of own areas, in this run
  std::map<slam::Origin, types::Se2> frames_;
  slam::Origin self_;
  team::LogAreas log_;
  bool changed_ = false;
};

}  // namespace topo::daemon

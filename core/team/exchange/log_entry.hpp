// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/se2.hpp"

// The log that all robots of a team share: what each visited and looked into, areas to keep out of and
// to go to first, and the operator's orders with their acknowledgements. Entries are immutable; the state is
// a fold over them in the order of their numbers. Places are in the map frame of the entry's origin.
namespace topo::team {

/// The key of an entry: its origin and the number there.
using EntryId = slam::KeyframeId;

/// A goal was visited and nothing more can be seen from there (StatusMessage::visited), or, `again`, it is a
/// goal once more.
struct Visited {
  types::Vector2 p_map{0.0, 0.0};
  bool again = false;
  friend bool operator==(const Visited&, const Visited&) = default;
};

/// An opening was looked into in the final sweep (StatusMessage::looked), or, `again`, needs it once more.
struct LookedInto {
  types::Vector2 p_map{0.0, 0.0};
  bool again = false;
  friend bool operator==(const LookedInto&, const LookedInto&) = default;
};

/// An area that no robot may enter, 3 to kCornersMax corners.
struct KeepOut {
  types::Polygon corners_map;
  friend bool operator==(const KeepOut&, const KeepOut&) = default;
};
inline constexpr std::size_t kCornersMax = 60;

/// An area whose goals come before all others, 3 to kCornersMax corners.
struct HereFirst {
  types::Polygon corners_map;
  friend bool operator==(const HereFirst&, const HereFirst&) = default;
};

/// A correction of its robot's map moved an area: its corners there now, as many as it has. Of the entries of
/// the area's own origin the last one holds; others say nothing.
struct AreaMoved {
  EntryId area;
  types::Polygon corners_map;
  friend bool operator==(const AreaMoved&, const AreaMoved&) = default;
};

/// An area that is no more, whoever drew it.
struct Withdrawn {
  EntryId area;
  friend bool operator==(const Withdrawn&, const Withdrawn&) = default;
};

enum class OrderKind : std::uint8_t {
  kStop = 0,   ///< the mission ends, the robot stands
  kEstop = 1,  ///< the emergency stop, which latches
  kStart = 2,  ///< a mission: exploring, and home at its end
  kPause = 3,
  kResume = 4,
  kHome = 5,
};
inline constexpr std::uint8_t kOrderKinds = 6;
std::string_view to_text(OrderKind kind);

/// After these a robot drives that stood: they are obeyed at once or not at all.
[[nodiscard]] inline bool sets_in_motion(OrderKind kind) {
  return kind == OrderKind::kStart || kind == OrderKind::kResume || kind == OrderKind::kHome;
}

/// An order of the operator to all robots of the team, or to one.
struct Order {
  OrderKind kind = OrderKind::kStop;
  std::optional<std::uint16_t> to = std::nullopt;  ///< this robot alone
  [[nodiscard]] bool is_for(std::uint16_t robot) const { return !to || *to == robot; }
  friend bool operator==(const Order&, const Order&) = default;
};

/// The origin's robot has carried out an order, or refuses it.
struct Acknowledgement {
  EntryId order;
  std::string refused{};  ///< why, at most kRefusalBytesMax of printable text; empty: it was carried out
  friend bool operator==(const Acknowledgement&, const Acknowledgement&) = default;
};

inline constexpr std::size_t kRefusalBytesMax = 200;

using LogBody =
    std::variant<Visited, LookedInto, KeepOut, Order, Acknowledgement, Withdrawn, HereFirst, AreaMoved>;

struct LogEntry {
  EntryId id;
  LogBody body;
  friend bool operator==(const LogEntry&, const LogEntry&) = default;
};

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/se2.hpp"

// The log that all robots of a team share: what each visited and looked into, areas to keep out of, and the
// operator's orders with their acknowledgements. Entries are immutable; the state is a fold over them in the
// order of their numbers. Places are in the map frame of the entry's origin.
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

enum class OrderKind : std::uint8_t {
  kStop = 0,   ///< the mission ends, the robot stands
  kEstop = 1,  ///< the emergency stop, which latches
};
std::string_view to_text(OrderKind kind);

/// An order of the operator to all robots of the team.
struct Order {
  OrderKind kind = OrderKind::kStop;
  friend bool operator==(const Order&, const Order&) = default;
};

/// The origin's robot has carried out an order.
struct Acknowledgement {
  EntryId order;
  friend bool operator==(const Acknowledgement&, const Acknowledgement&) = default;
};

using LogBody = std::variant<Visited, LookedInto, KeepOut, Order, Acknowledgement>;

struct LogEntry {
  EntryId id;
  LogBody body;
  friend bool operator==(const LogEntry&, const LogEntry&) = default;
};

}  // namespace topo::team

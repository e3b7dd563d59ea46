// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::team {

/// What a robot can be counted on for.
enum class Duty : std::uint8_t {
  kAble,    ///< explores, or waits for a goal
  kUnable,  ///< lost, stopped, paused or told to do something else
  kOver,    ///< its mission is: it is home, or has ended where it is
};
std::string_view to_text(Duty duty);

/// A goal that a robot could go to, and what that would cost it: the way, less what it gets off for being on
/// its way there already, so that robots do not swap goals without gain.
struct Bid {
  types::Vector2 p_map{0.0, 0.0};
  double cost_m = 0.0;
  bool essential = true;  ///< not just a gap to be filled in: the building goes on there
};

/// What one robot tells the others once a planning period: everything that its team decides by.
struct StatusMessage {
  std::uint16_t robot = 0;
  std::uint64_t sequence = 0;  ///< counts the robot's messages
  types::Se2 T_map_base;
  types::Vector2 start{0.0, 0.0};      ///< where it entered, in map: a place to come home to
  std::optional<types::Vector2> home;  ///< the start, its own or another's, that it comes home to now
  Duty duty = Duty::kUnable;
  /// The goal that it is on its way to, at what it cost when it was taken: a number that is the same for all
  /// who have heard of the claim, however long ago.
  std::optional<Bid> claim;
  std::vector<Bid> bids;  ///< every goal that it could go to
  /// Goals that it has been at, and from where no more could be seen: no reason for anybody to go there.
  std::vector<types::Vector2> visited;
  /// Openings that it has looked into in its last sweep (exploration/final_sweep.hpp): nobody needs to again.
  std::vector<types::Vector2> looked;
  std::vector<types::Vector2> way_map;  ///< the next metres of its route, from the robot on; empty: it stands
};

/// Bids no further apart are for one goal: robots see it from different maps.
inline constexpr double kSameGoal_m = 1.5;

bool is_same_goal(const types::Vector2& a, const types::Vector2& b);

/// Of two claims on one goal the lower cost, then the lower id, wins (DESIGN "Exploration").
bool beats(const Bid& a, std::uint16_t robot_a, const Bid& b, std::uint16_t robot_b);

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/types/se2.hpp"
#include "core/types/stamp.hpp"

namespace topo::team {

/// What the team can expect from a robot.
enum class Duty : std::uint8_t {
  kAble,    ///< explores, or waits for a goal
  kUnable,  ///< lost, stopped, paused or under another command
  kOver,    ///< its mission is over: it is at home, or has ended where it is
};
std::string_view to_text(Duty duty);

/// A goal that a robot could go to, and its cost: the route, less a bonus for the goal that the robot is
/// already heading for (hysteresis), so that robots do not swap goals without gain.
struct Bid {
  types::Vector2 p_map{0.0, 0.0};
  double cost_m = 0.0;
  bool essential = true;  ///< the building continues there; false: only a gap to be filled
};

/// A keyframe of a robot's own with its pose in that robot's map: a team-mate whose map holds it too knows
/// how the two maps lie to each other.
struct Anchor {
  std::uint32_t run = 0, sequence = 0;
  types::Se2 T_map_base;
};
inline constexpr std::size_t kAnchorsMax = 2;  ///< the first keyframe of a run, and a late one

/// What a robot sends to its team-mates once per planning period: all inputs of the team's decisions.
struct StatusMessage {
  std::uint16_t robot = 0;
  std::uint64_t sequence = 0;  ///< counts the robot's messages
  types::Se2 T_map_base;
  types::Vector2 start{0.0, 0.0};      ///< where it entered, in map: a possible home
  std::optional<types::Vector2> home;  ///< the start, own or another's, to which it is returning
  Duty duty = Duty::kUnable;
  /// The goal that the robot is heading for, with the cost at which it was taken: a number that is the same
  /// for all receivers of the claim, regardless of its age.
  std::optional<Bid> claim;
  std::vector<Bid> bids;  ///< every goal that it could go to
  /// Goals that the robot has visited and from which nothing more can be seen: no robot needs to go there.
  std::vector<types::Vector2> visited;
  /// Openings that it has looked into in its final sweep (exploration/final_sweep.hpp): no robot needs to
  /// again.
  std::vector<types::Vector2> looked;
  /// Its map frame is the common frame of the team: it started at a configured pose in that.
  bool in_common_frame = false;
  std::vector<Anchor> anchors;          ///< at most kAnchorsMax, the first keyframe of its run first
  std::vector<types::Vector2> way_map;  ///< the next metres of its route, from the robot on; empty: it stands
};

/// Bids are sent in such steps (core/team/exchange).
inline constexpr double kBidStep_m = 0.01;

/// The bid as team-mates receive it. A robot decides with its own bids in this form: all robots of a team
/// then decide with the same numbers.
[[nodiscard]] Bid in_steps(const Bid& bid);

/// Bids at most this far apart are for one goal: robots see it from different maps. A constant and no
/// parameter: all robots of a team must use one value, as they use one format of messages.
inline constexpr double kSameGoal_m = 1.5;

bool is_same_goal(const types::Vector2& a, const types::Vector2& b);

/// Of two claims on one goal the one with the lower cost wins, then the lower id (DESIGN "Exploration").
bool beats(const Bid& a, std::uint16_t robot_a, const Bid& b, std::uint16_t robot_b);
/// True when another robot claims the goal of a robot's bid, and its claim beats the bid.
bool is_beaten(const Bid& bid, std::uint16_t robot, std::span<const StatusMessage* const> team);

/// A status message transformed from a team-mate's map frame into the robot's own.
StatusMessage in_frame(const types::Se2& T_map_mates, StatusMessage message);

}  // namespace topo::team

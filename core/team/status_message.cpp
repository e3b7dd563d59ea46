// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/status_message.hpp"

#include <algorithm>
#include <cmath>

namespace topo::team {

std::string_view to_text(Duty duty) {
  switch (duty) {
    case Duty::kAble:
      return "able";
    case Duty::kUnable:
      return "unable";
    case Duty::kOver:
      return "over";
  }
  return "unknown";
}

Bid in_steps(const Bid& bid) {
  const auto rounded_m = [](double value_m) { return std::round(value_m / kBidStep_m) * kBidStep_m; };
  return {{rounded_m(bid.p_map.x()), rounded_m(bid.p_map.y())}, rounded_m(bid.cost_m), bid.essential};
}

bool is_same_goal(const types::Vector2& a, const types::Vector2& b) {
  return (a - b).squaredNorm() <= kSameGoal_m * kSameGoal_m;
}

bool beats(const Bid& a, std::uint16_t robot_a, const Bid& b, std::uint16_t robot_b) {
  return a.cost_m != b.cost_m ? a.cost_m < b.cost_m : robot_a < robot_b;
}

bool is_beaten(const Bid& bid, std::uint16_t robot, std::span<const StatusMessage* const> team) {
  return std::any_of(team.begin(), team.end(), [&](const StatusMessage* mate) {
    return mate->claim && mate->robot != robot && is_same_goal(mate->claim->p_map, bid.p_map) &&
           beats(*mate->claim, mate->robot, bid, robot);
  });
}

StatusMessage in_frame(const types::Se2& T_map_mates, StatusMessage message) {
  const auto move = [&](types::Vector2& p) { p = T_map_mates * p; };
  message.T_map_base = T_map_mates * message.T_map_base;
  move(message.start);
  if (message.home) move(*message.home);
  if (message.claim) move(message.claim->p_map);
  for (Bid& bid : message.bids) move(bid.p_map);
  for (types::Vector2& place : message.visited) move(place);
  for (types::Vector2& opening : message.looked) move(opening);
  for (types::Vector2& point : message.way_map) move(point);
  return message;
}

}  // namespace topo::team

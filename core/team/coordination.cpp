// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/coordination.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "core/team/baselines.hpp"
#include "core/team/k_means.hpp"
#include "core/team/shares.hpp"

namespace topo::team {
namespace {

constexpr double kScannerRange_m = 30.0;  // of a UTM-30LX, by its datasheet; used by Rule::kUtility

/// The distinct goals of all bids, in the order of comes_before: a bid for the same goal as an earlier one
/// adds none.
std::vector<types::Vector2> goals_of(std::span<const StatusMessage* const> team) {
  std::vector<types::Vector2> points, goals;
  for (const StatusMessage* message : team) {
    for (const Bid& bid : message->bids) points.push_back(bid.p_map);
  }
  std::sort(points.begin(), points.end(), comes_before);
  for (const types::Vector2& p : points) {
    if (std::none_of(goals.begin(), goals.end(), [&](const auto& goal) { return is_same_goal(goal, p); }))
      goals.push_back(p);
  }
  return goals;
}

/// The goal, of goals_of(), that a bid is for: the nearest.
std::size_t goal_of(const std::vector<types::Vector2>& goals, const Bid& bid) {
  const auto nearest = std::min_element(goals.begin(), goals.end(), [&](const auto& a, const auto& b) {
    return (a - bid.p_map).squaredNorm() < (b - bid.p_map).squaredNorm();
  });
  return static_cast<std::size_t>(nearest - goals.begin());
}

/// The cost of each robot's bids for each goal, in the order of ids; of several bids of one robot for one
/// goal the cheapest counts.
CostTable table_of(std::span<const StatusMessage* const> team) {
  std::vector<std::uint16_t> robots;
  for (const StatusMessage* message : team) robots.push_back(message->robot);
  CostTable table(std::move(robots), goals_of(team));
  for (std::size_t goal = 0; goal < table.goals().size(); ++goal) table.set_essential(goal, false);
  for (std::size_t row = 0; row < team.size(); ++row) {
    for (const Bid& bid : team[row]->bids) {
      const std::size_t goal = goal_of(table.goals(), bid);
      if (bid.essential) table.set_essential(goal, true);
      double& cost_m = table.cost_m(row, goal);
      cost_m = std::min(cost_m, bid.cost_m);
    }
  }
  return table;
}

/// The table, where a claimed goal costs its claimant at most the cost of the claim.
CostTable with_claims(CostTable table, std::span<const StatusMessage* const> team) {
  for (std::size_t row = 0; row < team.size(); ++row) {
    for (std::size_t goal = 0; team[row]->claim && goal < table.goals().size(); ++goal) {
      double& cost_m = table.cost_m(row, goal);
      const Bid& claim = *team[row]->claim;
      if (cost_m < HUGE_VAL && is_same_goal(claim.p_map, table.goals()[goal]))
        cost_m = std::min(cost_m, claim.cost_m);
    }
  }
  return table;
}

/// The robot's cheapest bid for a goal.
const Bid& cheapest_for(const StatusMessage& self, const CostTable& table, std::size_t goal) {
  const Bid* best = nullptr;
  for (const Bid& bid : self.bids) {
    if (goal_of(table.goals(), bid) != goal) continue;
    const bool better = best == nullptr || bid.cost_m < best->cost_m ||
                        (bid.cost_m == best->cost_m && comes_before(bid.p_map, best->p_map));
    if (better) best = &bid;
  }
  return *best;
}

/// The robot's bids in the cluster of a goal, plus the bid for its current goal, whatever its cluster is now:
/// clusters change with every new goal, and turning back for that wastes both routes.
std::vector<std::size_t> share_of(const StatusMessage& self, const CostTable& table, std::size_t row,
                                  std::size_t assigned, Rule rule) {
  const std::vector<std::size_t> cluster = clusters_of(table, rule == Rule::kClusters);
  std::vector<std::size_t> share;
  for (std::size_t i = 0; i < self.bids.size(); ++i) {
    const std::size_t goal = goal_of(table.goals(), self.bids[i]);
    const bool own = self.claim && self.claim->p_map == self.bids[i].p_map;
    if (table.cost_m(row, goal) < HUGE_VAL && (own || cluster[goal] == cluster[assigned])) share.push_back(i);
  }
  return share;
}

/// Each robot's claim.
Assignment claims_of(std::span<const StatusMessage* const> team, const CostTable& table) {
  Assignment claims(team.size());
  for (std::size_t row = 0; row < team.size(); ++row) {
    if (team[row]->claim && !table.goals().empty()) {
      const std::size_t goal = goal_of(table.goals(), *team[row]->claim);
      if (is_same_goal(table.goals()[goal], team[row]->claim->p_map)) claims[row] = goal;
    }
  }
  return claims;
}

/// The robot's bids for its goals (shares.hpp), and the bid for its current goal, whoever is nearer now.
std::vector<std::size_t> nearest_share(const StatusMessage& self, const CostTable& table, std::size_t row,
                                       const Assignment& claims, const MapView& map) {
  const std::function<double(std::size_t, std::size_t)> between = [&](std::size_t a, std::size_t b) {
    return map.between_m(table.goals()[a], table.goals()[b]);
  };
  const std::vector<std::size_t> goals = share_of_goals({table, claims, between}, row);
  std::vector<std::size_t> share;
  for (std::size_t i = 0; i < self.bids.size(); ++i) {
    const std::size_t goal = goal_of(table.goals(), self.bids[i]);
    const bool own = self.claim && self.claim->p_map == self.bids[i].p_map;
    if (table.cost_m(row, goal) < HUGE_VAL && (own || std::ranges::binary_search(goals, goal)))
      share.push_back(i);
  }
  return share;
}

Assignment assign(Rule rule, const CostTable& table, const PointsInSight& in_sight) {
  switch (rule) {
    case Rule::kInTurn:
      return assign_in_turn(table);
    case Rule::kUtility:
      return assign_by_utility(
          table, [&](std::size_t a, std::size_t b) { return in_sight(table.goals()[a], table.goals()[b]); },
          kScannerRange_m);
    case Rule::kMinPos:
      return assign_min_pos(table);
    case Rule::kAlone:
    case Rule::kClusters:
    case Rule::kNoClusters:
    case Rule::kShares:
      break;
  }
  return assign_clusters(table, rule == Rule::kClusters);
}

/// True when a team-mate has a better claim on the robot's bid. For the robot's own claim the cost of the
/// claim counts.
bool is_claimed(const Bid& bid, const StatusMessage& self, std::span<const StatusMessage* const> mates) {
  const bool own = self.claim && self.claim->p_map == bid.p_map;
  return is_beaten(own ? *self.claim : bid, self.robot, mates);
}

/// True when a team-mate, continuing from its own goal in a straight line of sight, reaches the robot's goal
/// no later than the robot.
bool is_passed_by(const CostTable& table, const Assignment& assigned, std::size_t row, std::size_t goal,
                  const PointsInSight& in_sight) {
  const types::Vector2& wanted = table.goals()[goal];
  for (std::size_t mate = 0; mate < assigned.size(); ++mate) {
    if (mate == row || !assigned[mate]) continue;
    const types::Vector2& first = table.goals()[*assigned[mate]];
    const double cost_m = table.cost_m(mate, *assigned[mate]) + (wanted - first).norm();
    if (cost_m <= table.cost_m(row, goal) && in_sight(first, wanted)) return true;
  }
  return false;
}

std::size_t cheapest_of(std::span<const std::size_t> share, const StatusMessage& self) {
  return *std::ranges::min_element(share, [&](std::size_t a, std::size_t b) {
    const Bid &one = self.bids[a], &other = self.bids[b];
    return one.cost_m != other.cost_m ? one.cost_m < other.cost_m : comes_before(one.p_map, other.p_map);
  });
}

/// Rule::kShares. `team`: all robots, in the rows of the table.
std::optional<std::size_t> by_shares(const StatusMessage& self, std::size_t row, CostTable table,
                                     std::span<const StatusMessage* const> team, const MapView& map,
                                     const Chooser& choose) {
  Assignment claims = claims_of(team, table);
  for (;;) {  // terminates: every round removes a goal
    const std::vector<std::size_t> share = nearest_share(self, table, row, claims, map);
    if (share.empty()) return std::nullopt;
    const std::size_t bid = choose ? choose(share) : cheapest_of(share, self),
                      goal = goal_of(table.goals(), self.bids[bid]);
    if (!is_claimed(self.bids[bid], self, team) && !is_passed_by(table, claims, row, goal, map.in_sight))
      return bid;
    if (claims[row] == goal) claims[row].reset();
    table.cost_m(row, goal) = HUGE_VAL;
  }
}

}  // namespace

std::optional<std::size_t> coordinate(Rule rule, const StatusMessage& self,
                                      std::span<const StatusMessage* const> mates, const MapView& map,
                                      const Chooser& choose) {
  const PointsInSight& in_sight = map.in_sight;
  if (rule == Rule::kAlone) mates = {};
  const bool claims = rule == Rule::kClusters || rule == Rule::kNoClusters;
  const auto by_id = [](const StatusMessage* a, const StatusMessage* b) { return a->robot < b->robot; };
  std::set<const StatusMessage*, decltype(by_id)> team(by_id);
  team.insert(&self);
  team.insert(mates.begin(), mates.end());
  const std::vector<const StatusMessage*> messages(team.begin(), team.end());
  const auto row = static_cast<std::size_t>(std::distance(team.begin(), team.find(&self)));
  CostTable table = table_of(messages);
  if (rule == Rule::kShares) return by_shares(self, row, std::move(table), messages, map, choose);
  for (;;) {  // terminates: every round removes a goal
    const Assignment assigned = assign(rule, claims ? with_claims(table, messages) : table, in_sight);
    if (!assigned[row]) return std::nullopt;
    const Bid& bid = claims && choose ? self.bids[choose(share_of(self, table, row, *assigned[row], rule))]
                                      : cheapest_for(self, table, *assigned[row]);
    const std::size_t goal = goal_of(table.goals(), bid);
    const bool left =
        claims && (is_claimed(bid, self, mates) || is_passed_by(table, assigned, row, goal, in_sight));
    if (!left) return static_cast<std::size_t>(&bid - self.bids.data());
    table.cost_m(row, goal) = HUGE_VAL;
  }
}

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/goals/filters.hpp"
#include "core/grid/nearest_reachable.hpp"
#include "core/pipeline/planning_state.hpp"
#include "core/team/coordination.hpp"
#include "core/team/homes.hpp"
#include "core/team/right_of_way.hpp"

namespace topo::pipeline {
namespace {

using types::Vector2;

constexpr double kWay_m = 6.0;          // of a route that the others are told
constexpr double kWaySpacing_m = 0.3;   // finer than a robot is wide
constexpr double kRoomSearch_m = 12.0;  // to the next door or junction of a corridor
constexpr double kRoomReached_m = 0.10;
constexpr double kCrowd_m = 1.2;   // around a mate, where a route is dear
constexpr double kBehind_m = 1.5;  // half a metre of backing off, and two robots' length
constexpr types::Duration kRoomFor = std::chrono::seconds(30);  // then it is of no use

team::Rule rule_of(const PlannerParams& params) {
  switch (params.strategy) {
    case exploration::Strategy::kTopometric:
      return params.k_means ? team::Rule::kClusters : team::Rule::kNoClusters;
    case exploration::Strategy::kNearestFrontier:
      return team::Rule::kAlone;
    case exploration::Strategy::kGreedyFrontier:
      return team::Rule::kInTurn;
    case exploration::Strategy::kUtilityFrontier:
      return team::Rule::kUtility;
    case exploration::Strategy::kMinPos:
      return team::Rule::kMinPos;
  }
  return team::Rule::kAlone;
}

/// Where a goal is, for the others: at the opening, which all see at one place. From where a robot would look
/// into it depends on what else it would see from there, and may be metres away (core/goals/goal_cover.hpp).
/// Gaps are looked into from beside them.
const Vector2& told(const goals::Goal& goal) {
  return goal.side != goals::Side::kNone ? goal.opening : goal.p_map;
}

/// The next metres of a route, spaced for the others.
std::vector<Vector2> beginning_of(const std::vector<Vector2>& route) {
  std::vector<Vector2> way;
  double gone_m = 0.0, next_m = 0.0;
  for (std::size_t i = 0; i < route.size() && gone_m <= kWay_m; ++i) {
    if (i > 0) gone_m += (route[i] - route[i - 1]).norm();
    if (gone_m < next_m) continue;
    way.push_back(route[i]);
    next_m = gone_m + kWaySpacing_m;
  }
  return way;
}

}  // namespace

void PlanningState::Impl::hear(const PlanningInput& in) {
  for (const team::StatusMessage& message : in.team->messages) {
    const bool newer = message.robot != in.team->robot && roster.take(message, in.now);
    if (newer && message.duty != team::Duty::kOver) contact.heard(T_map_base.se2().translation(), in.now);
  }
  if (!roster.any_at_work()) contact.forget();
  going_at = roster.going_at(in.now);
}

bool PlanningState::Impl::is_going_mate(const Vector2& p_map) const {
  return std::any_of(going_at.begin(), going_at.end(),
                     [&](const Vector2& mate) { return (mate - p_map).norm() <= team::kMateRadius_m; });
}

bool PlanningState::Impl::slows_for_mate(const PlanningInput& in) const {
  team::StatusMessage self;
  self.robot = in.team->robot;
  self.T_map_base = T_map_base.se2();
  const auto heard = roster.heard(in.now);
  return std::any_of(heard.begin(), heard.end(), [&](const team::StatusMessage* mate) {
    return team::slows_for(self, *mate, types::to_seconds(roster.age_of(*mate, in.now)));
  });
}

bool PlanningState::Impl::is_mate_behind(const PlanningInput& in) const {
  const auto heard = roster.heard(in.now);
  return std::any_of(heard.begin(), heard.end(), [&](const team::StatusMessage* message) {
    const Vector2 at = T_map_base.se2().inverse() * message->T_map_base.translation();
    return at.x() < 0.0 && at.norm() <= kBehind_m;
  });
}

void PlanningState::Impl::crowd_mates() {
  const auto reach = static_cast<std::int32_t>(std::ceil(kCrowd_m / map.resolution_m));
  const auto least_m = static_cast<float>(params.travel.radius_m);
  for (const Vector2& mate : going_at) {
    const grid::CellIndex centre = map.cell_at(mate);
    for (std::int32_t dy = -reach; dy <= reach; ++dy) {
      for (std::int32_t dx = -reach; dx <= reach; ++dx) {
        const grid::CellIndex cell{centre.x + dx, centre.y + dy};
        if (!map.contains(cell) || dx * dx + dy * dy > reach * reach) continue;
        float& room_m = travel_clearance_m[map.index(cell)];
        room_m = std::min(room_m, least_m);
      }
    }
  }
}

const exploration::Candidate* PlanningState::Impl::pick(const PlanningInput& in,
                                                        std::span<const exploration::Candidate> candidates,
                                                        const exploration::Candidate* present) {
  const bool tours = params.strategy == exploration::Strategy::kTopometric;
  if (in.team == nullptr) {
    if (!tours) return exploration::choose(candidates, present, params.switch_gain);
    std::vector<const exploration::Candidate*> all;
    for (const exploration::Candidate& c : candidates) all.push_back(&c);
    return first_of_tour(std::move(all), present);
  }
  bids.clear();
  for (const exploration::Candidate& c : candidates)
    bids.push_back({told(c.goal), exploration::weighed_cost_m(c, present, params.switch_gain),
                    c.goal.side != goals::Side::kNone});
  team::StatusMessage self;
  self.robot = in.team->robot;
  self.bids = bids;
  if (present != nullptr) self.claim = team::Bid{told(present->goal), claimed_m};
  const auto in_sight = [&](const Vector2& a, const Vector2& b) {
    return goals::sees(map, map.cell_at(a), map.cell_at(b));
  };
  const team::Chooser by_tour = [&](std::span<const std::size_t> share) {
    std::vector<const exploration::Candidate*> among;
    for (const std::size_t i : share) among.push_back(&candidates[i]);
    return static_cast<std::size_t>(first_of_tour(std::move(among), present) - candidates.data());
  };
  const auto chosen = team::coordinate(rule_of(params), self, roster.counted(in.now), in_sight,
                                       tours ? by_tour : team::Chooser{});
  return chosen ? &candidates[*chosen] : nullptr;
}

bool PlanningState::Impl::is_coordinated(const PlanningInput& in) const {
  return in.team != nullptr && rule_of(params) != team::Rule::kAlone;
}

bool PlanningState::Impl::mate_was_at(const PlanningInput& in, const exploration::Candidate& candidate,
                                      double within_m) const {
  const auto heard = roster.heard(in.now);
  return std::any_of(heard.begin(), heard.end(), [&](const team::StatusMessage* message) {
    return std::any_of(message->visited.begin(), message->visited.end(),
                       [&](const Vector2& p) { return (p - candidate.goal.p_map).norm() <= within_m; });
  });
}

bool PlanningState::Impl::others_have_goals(const PlanningInput& in) const {
  if (!is_coordinated(in)) return false;
  const auto counted = roster.counted(in.now);
  return std::any_of(counted.begin(), counted.end(), [](const team::StatusMessage* message) {
    return message->claim || !message->bids.empty();
  });
}

PlanningState::Impl::Claims PlanningState::Impl::claims_of_mates(const PlanningInput& in) const {
  Claims claims;
  for (const team::StatusMessage* message : roster.counted(in.now)) {
    const auto claimed = message->claim ? std::optional(message->claim->p_map) : std::nullopt;
    claims.emplace_back(message->robot, claimed);
  }
  return claims;
}

bool PlanningState::Impl::mates_claim_the_same(const PlanningInput& in) const {
  const Claims now = claims_of_mates(in);
  return std::equal(now.begin(), now.end(), claims_then.begin(), claims_then.end(),
                    [](const auto& a, const auto& b) {
                      if (a.first != b.first || a.second.has_value() != b.second.has_value()) return false;
                      return !a.second || team::is_same_goal(*a.second, *b.second);
                    });
}

void PlanningState::Impl::wait_for_goal(const PlanningInput& in, const char* why) {
  if (goal) note(in, goal->p_map, "left to another");
  goal.reset();
  has_target = false;
  activity = Activity::kThinking;
  reason = why;
  last_progress = in.now;
}

const team::StatusMessage* PlanningState::Impl::who_needs_room(const PlanningInput& in) const {
  if (in.now < ignore_room_until) return nullptr;
  team::StatusMessage self;
  self.robot = in.team->robot;
  self.T_map_base = T_map_base.se2();
  if (has_target) self.way_map = beginning_of(route);
  return team::who_needs_room(self, roster.heard(in.now));
}

bool PlanningState::Impl::right_of_way_changed(const PlanningInput& in) const {
  return !room && who_needs_room(in) != nullptr;
}

bool PlanningState::Impl::moves_up_for(const PlanningInput& in, const team::StatusMessage& mate) const {
  team::StatusMessage self;
  self.T_map_base = T_map_base.se2();
  return comes_home_with_others(in) && mate.home && home && team::is_at_home(self, *home) &&
         !team::is_at_home(mate, {mate.robot, *mate.home});
}

bool PlanningState::Impl::make_room(const PlanningInput& in) {
  const std::vector<const team::StatusMessage*> heard = roster.heard(in.now);
  if (!room) {
    const team::StatusMessage* mate = who_needs_room(in);
    if (mate == nullptr || moves_up_for(in, *mate)) return false;
    room = Room{mate->robot, T_map_base.se2().translation(), in.now, target};
    ++goal_id;  // what control says of this way is not about the goal
    note(in, room->asked_at, "makes room for robot " + std::to_string(mate->robot));
  }
  const auto mate = std::find_if(heard.begin(), heard.end(), [&](const team::StatusMessage* message) {
    return message->robot == room->mate;
  });
  const team::RightOfWayParams limits;
  const auto in_the_way = [&](const Vector2& p) { return (p - room->asked_at).norm() < limits.room_m; };
  const bool room_timed_out = in.now - room->since > kRoomFor;
  if (room_timed_out) ignore_room_until = in.now + kRoomFor;
  if (mate == heard.end() || room_timed_out ||
      std::none_of((*mate)->way_map.begin(), (*mate)->way_map.end(), in_the_way)) {
    target = room->goal_target;  // who stands in the room is not at the goal
    room.reset();
    ++goal_id;
    return false;
  }
  search.settle(2.0 * kRoomSearch_m);
  const auto cell = team::room_beside(map, field, **mate, heard, kRoomSearch_m);
  has_target = cell && (map.centre_of(*cell) - T_map_base.se2().translation()).norm() > kRoomReached_m;
  if (has_target) target = *cell;
  reason = "makes room for robot " + std::to_string(room->mate);
  last_progress = goal_taken = in.now;
  return true;
}

bool PlanningState::Impl::comes_home_with_others(const PlanningInput& in) const {
  return in.team != nullptr && returning && mission.order == Order::kExplore;
}

Vector2 PlanningState::Impl::home_of(const PlanningInput& in) {
  Vector2 start = T_map_start.se2().translation();
  if (!comes_home_with_others(in)) return start;
  team::StatusMessage self;
  self.robot = in.team->robot;
  self.start = start;
  self.T_map_base = T_map_base.se2();
  const auto cell_at = [&](const Vector2& p) {
    return grid::nearest_reachable(map, field, map.cell_at(p), params.home_reached_m);
  };
  const auto cost_m = [&](const Vector2& p) {
    search.settle(HUGE_VAL);
    const auto cell = cell_at(p);
    return cell ? static_cast<double>(field.cost_m[map.index(*cell)]) : HUGE_VAL;
  };
  if (home) search.settle(params.home_reached_m);  // before, nothing is in reach
  if (home && !cell_at(home->p_map)) home.reset();
  const std::optional<team::Home> chosen =
      team::choose_home(self, roster.heard(in.now), home, who_needs_room(in), cost_m);
  const bool same = chosen && home ? chosen->robot == home->robot : !chosen && !home;
  if (!same && goal) {
    goal.reset();  // another way: what was said of the old one is not about it
    thought = {};
  }
  home = chosen;
  return home ? home->p_map : start;
}

void PlanningState::Impl::wait_at_home(const PlanningInput& in) {
  at_home = true;
  if (roster.all_home(in.now)) {
    if (cut_short) return end(Activity::kFailed, return_reason + ": came home");
    reason = return_reason;
    return;
  }
  ended = false;
  activity = Activity::kReturning;
  reason = "home, waits for the others";
}

team::StatusMessage PlanningState::Impl::make_message(const PlanningInput& in) const {
  team::StatusMessage message;
  message.robot = in.team->robot;
  message.sequence = messages;
  message.T_map_base = T_map_base.se2();
  message.start = T_map_start.se2().translation();
  if (returning && home) message.home = home->p_map;
  if (ended || at_home)
    message.duty = team::Duty::kOver;
  else if (located && !in.control->estop_latched && !mission.paused && mission.order == Order::kExplore)
    message.duty = team::Duty::kAble;
  if (has_target) message.way_map = beginning_of(route);
  message.visited = deferred.visited(in.now);
  message.looked = looks.looked();
  // Who is unable says on what it claimed: the others decide by how long it has been so (roster.hpp).
  if (ended || at_home || returning || mission.order != Order::kExplore) return message;
  message.bids = bids;
  if (goal && !seeks_contact) message.claim = team::Bid{told(*goal), claimed_m};
  return message;
}

}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/grid/nearest_reachable.hpp"
#include "core/pipeline/planning_state.hpp"
#include "core/travel/path.hpp"

namespace topo::pipeline {
namespace {

constexpr std::size_t kDecisionsKept = 64;
// Two recoveries of control, waiting, backing off and turning. To say of itself that it is stuck control
// takes up to a minute; another goal, or another way to this one, is the better use of that time.
constexpr types::Duration kStandstill = std::chrono::seconds(25);
constexpr double kProgress_m = 0.5;
constexpr types::Duration kGoalTimeMax = std::chrono::seconds(240);
constexpr types::Duration kPatience = std::chrono::seconds(6);
constexpr int kResumesMax = 8;             // an exploration ends
constexpr int kCaughtMax = 16;             // and so it does for a robot that is never free again
constexpr double kResumeFor_m = 1.2;       // a narrower gap does not turn a robot round on its way home
constexpr double kBlockedAhead_m = 0.45;   // from the centre of the robot to what it got stuck on
constexpr double kTightAhead_m = 1.2;      // a passage that it stands before, and does not get into
constexpr double kHomeWhenStuck_m = 0.45;  // of what is home, half a metre: who gets no nearer is there
constexpr types::Duration kBlockedFor =
    std::chrono::minutes(5);  // what no laser sees is glass more often than a person

std::string metres(double value) {
  std::array<char, 24> text{};
  const int n = std::snprintf(text.data(), text.size(), "%.1f m", value);
  return {text.data(), std::min(static_cast<std::size_t>(std::max(n, 0)), text.size() - 1)};
}

/// Label of the place that a point is in; 0: none.
std::uint16_t place_at(const analysis::Analysis& analysis, const types::Vector2& p_map) {
  const grid::CellIndex cell = analysis.map.cell_at(p_map);
  if (!analysis.map.contains(cell) || analysis.places.labels.empty()) return 0;
  return analysis.places.labels[analysis.map.index(cell)];
}

std::string description(const goals::Goal& goal) {
  std::string text;
  if (goal.side != goals::Side::kNone) text = std::string(goals::to_text(goal.side)) + " side of ";
  text += goal.place != 0 ? "place " + std::to_string(goal.place) : "frontier";
  return text + ", opening " + metres(goal.opening_m);
}

}  // namespace

void PlanningState::Impl::note(const PlanningInput& in, const types::Vector2& p_map, std::string text) {
  if (decisions.size() == kDecisionsKept) decisions.erase(decisions.begin());
  decisions.push_back({in.now, p_map, std::move(text)});
}

void PlanningState::Impl::end(Activity how, std::string why) {
  activity = how;
  reason = std::move(why);
  ended = true;
  goal.reset();
  has_target = false;
}

void PlanningState::Impl::give_up(const PlanningInput& in, std::string why) {
  note(in, goal->p_map, "given up: " + why);
  // A look that is left says nothing of a goal beside it.
  if (!looks.leave(goal->p_map))
    deferred.give_up(goal->p_map, in.now + types::from_seconds(params.give_up_s), std::move(why));
  goal.reset();
}

/// Where the next metre of the route is narrowest, if the map, and not what passes by, is too narrow there to
/// turn in. Not where the robot stands: it may be near to something in the middle of a room.
std::optional<types::Vector2> PlanningState::Impl::tight_ahead() const {
  std::optional<types::Vector2> narrowest;
  if (route.empty()) return narrowest;
  auto least_m = static_cast<float>(params.travel.radius_m);
  const types::Vector2 here = T_map_base.se2().translation();
  double along_m = 0.0;
  for (std::size_t i = travel::nearest_point(route, here) + 1; i < route.size(); ++i) {
    along_m += (route[i] - route[i - 1]).norm();
    if (along_m >= kTightAhead_m) break;
    const grid::CellIndex cell = map.cell_at(route[i]);
    if (!map.contains(cell) || (route[i] - here).norm() < params.travel.radius_m) continue;
    const float clear_m = clearance.clearance_m()[map.index(cell)];
    if (clear_m >= least_m) continue;
    narrowest = route[i];
    least_m = clear_m;
  }
  return narrowest;
}

/// The robot did not get on here: whatever stands ahead, the next route goes round it. What is too tight is
/// so for the rest of the mission.
void PlanningState::Impl::block_ahead(const PlanningInput& in) {
  if (is_going_mate(T_map_base.se2() * types::Vector2(2.0 * kBlockedAhead_m, 0.0))) return;
  if (const auto tight = tight_ahead())
    too_tight.push_back(*tight);
  else
    blocked.push_back({T_map_base.se2() * types::Vector2(kBlockedAhead_m, 0.0), in.now + kBlockedFor, 1});
  thought = {};  // this period's costs do not know of it yet
}

/// It does not get on. A robot that is caught finds goals and loses them again where it stands; those were no
/// ways that opened, and once it is free the exploration goes on.
void PlanningState::Impl::give_up_caught(const PlanningInput& in, std::string why) {
  block_ahead(in);
  if (resumed > 0 && caught < kCaughtMax) {
    --resumed;
    ++caught;
  }
  give_up(in, std::move(why));
}

void PlanningState::Impl::set_out(const PlanningInput& in, const goals::Goal& to) {
  goal = to;
  ++goal_id;
  goal_taken = last_progress = in.now;
  progress_at = T_map_base.se2().translation();
}

types::Duration PlanningState::Impl::standing_for(const PlanningInput& in) {
  const types::Vector2 here = T_map_base.se2().translation();
  if ((here - progress_at).norm() > kProgress_m) {
    progress_at = here;
    last_progress = in.now;
  }
  return in.now - last_progress;
}

bool PlanningState::Impl::is_getting_on(const PlanningInput& in) { return standing_for(in) <= kStandstill; }

/// Is the present goal done with: reached, stuck on the way, no progress?
void PlanningState::Impl::settle_goal(const PlanningInput& in) {
  if (!goal) return;
  const types::Vector2 here = T_map_base.se2().translation();
  const bool about_this = in.control->goal_id == goal_id;
  if (about_this && in.control->mode == ControlMode::kStuck) return give_up_caught(in, "stuck on the way");
  const double reached_m = looks.reached_m(goal->p_map).value_or(params.goal_reached_m);
  if ((map.centre_of(target) - here).norm() <= reached_m ||
      (about_this && in.control->mode == ControlMode::kArrived)) {
    if (!looks.arrive(goal->p_map)) deferred.visit(goal->p_map, next_visit(in.now));
    note(in, goal->p_map, "reached");
    goal.reset();
    return;
  }
  if (!is_getting_on(in)) return give_up_caught(in, "no progress");
  if (in.now - goal_taken > kGoalTimeMax) give_up(in, "not reached in four minutes");
}

std::vector<exploration::Candidate> PlanningState::Impl::candidates_among(const PlanningInput& in,
                                                                          std::span<const goals::Goal> goals,
                                                                          bool& cut_off) const {
  std::vector<exploration::Candidate> found =
      exploration::candidates_of(goals, {map, clearance.clearance_m(), field, params.travel.radius_m},
                                 deferred, T_map_base.se2(), in.now, cut_off);
  if (is_coordinated(in))
    std::erase_if(found, [&](const exploration::Candidate& c) {
      return mate_was_at(in, c, exploration::DeferredGoals::kSame_m);
    });
  return found;
}

std::vector<exploration::Candidate> PlanningState::Impl::gap_candidates(
    const PlanningInput& in, std::span<const goals::Frontier> frontiers, double behind_min_m2,
    bool& cut_off) const {
  std::vector<goals::Goal> openings = exploration::frontier_goals(map, field, frontiers, behind_min_m2);
  // The places may be those of an older map.
  for (goals::Goal& opening : openings) opening.place = place_at(*analysis, opening.p_map);
  return candidates_among(in, openings, cut_off);
}

/// Frontiers with all costs that the choice can depend on: what is farther than the search has come is not
/// chosen. The nearest one is mostly near, and the building large. In a team it may be another's: all costs
/// are wanted.
std::vector<exploration::Candidate> PlanningState::Impl::frontier_candidates(const PlanningInput& in,
                                                                             bool& cut_off) {
  constexpr double kFirst_m = 6.0;
  const std::vector<goals::Frontier> frontiers = goals::find_frontiers(map, params.frontier_min_m);
  clusters = static_cast<int>(frontiers.size());
  second_phase = false;
  for (double bound_m = in.team == nullptr ? kFirst_m : HUGE_VAL;; bound_m *= 2.0) {
    search.settle(bound_m);
    cut_off = false;
    std::vector<exploration::Candidate> candidates = gap_candidates(in, frontiers, 0.0, cut_off);
    const double settled_m = search.settled_m();
    const bool is_enough = std::any_of(
        candidates.begin(), candidates.end(),
        [&](const exploration::Candidate& c) { return c.cost_m < params.switch_gain * settled_m; });
    if (std::isinf(settled_m) || is_enough) return candidates;
  }
}

void PlanningState::Impl::take_goal(const PlanningInput& in, const exploration::Candidate& candidate) {
  set_out(in, candidate.goal);
  target = candidate.cell;
  claimed_m = exploration::weighed_cost_m(candidate, &candidate, params.switch_gain);
  ++goals_issued;
  note(in, goal->p_map, "taken: " + description(*goal) + ", " + metres(candidate.cost_m) + " to go");
}

/// What to do when no goal is in reach: not at once the end, since a person may stand in a doorway.
void PlanningState::Impl::run_dry(const PlanningInput& in, bool cut_off) {
  has_target = false;
  activity = Activity::kThinking;
  if (nothing_since == types::Stamp{}) nothing_since = in.now;
  if (cut_off && forget_unseen(in)) {
    reason = "no way to the goals left: what only sonar heard is forgotten";
  } else if (cut_off && in.now - nothing_since < kPatience) {
    reason = "no way to the goals left just now";
  } else if (cut_off && !looks_meanwhile && looks_around()) {
    looks_meanwhile = true;
    reason = "no way to the goals left: looks into corners meanwhile";
  } else if (deferred.call_back(in.now)) {
    reason = "only goals given up before are left: they are tried again";
  } else if (in.team != nullptr && (others_have_goals(in) || in.now - nothing_since < kPatience)) {
    wait_for_goal(in, "waits: no goal is in reach, but others have some");
  } else {
    returning = true;
    return_reason = "explored: no goal is left in reach";
    note(in, T_map_start.se2().translation(), return_reason);
    go_home(in, return_reason);
  }
}

void PlanningState::Impl::explore(const PlanningInput& in) {
  if (!returning && in.team != nullptr && seek_contact(in)) return;
  if (!returning) settle_goal(in);
  bool cut_off = false;
  const std::vector<exploration::Candidate> candidates = params.strategy == exploration::Strategy::kTopometric
                                                             ? tour_candidates(in, cut_off)
                                                             : frontier_candidates(in, cut_off);
  open_goals.clear();
  for (const exploration::Candidate& c : candidates) open_goals.push_back(c.goal);
  if (returning) {
    const bool worth_it =
        std::any_of(candidates.begin(), candidates.end(),
                    [](const exploration::Candidate& c) { return c.goal.opening_m >= kResumeFor_m; });
    if (!worth_it || resumed == kResumesMax || pick(in, candidates, nullptr) == nullptr)
      return go_home(in, return_reason);
    ++resumed;  // a way has opened
    returning = false;
    goal.reset();
  }
  const exploration::Candidate* present = goal ? exploration::successor_of(*goal, candidates) : nullptr;
  const exploration::Candidate* best = pick(in, candidates, present);
  if (goal && present == nullptr) {
    note(in, goal->p_map, "dropped: seen, or no longer a goal");
    goal.reset();
  }
  if (best == nullptr && candidates.empty()) return run_dry(in, cut_off);
  nothing_since = {};
  if (best == nullptr) return wait_for_goal(in, "waits: others are nearer to every goal");
  ++decisions_made;
  clusters_sum += static_cast<std::uint64_t>(clusters);
  goals_sum += candidates.size();
  if (best == present) {
    goal = best->goal;  // it recedes; it stays the same goal
    target = best->cell;
  } else {
    if (goal) note(in, goal->p_map, "left for a nearer one");
    take_goal(in, *best);
  }
  has_target = true;
  activity = Activity::kExploring;
  reason = description(*goal);
}

/// The reachable cell nearest to a point, if there is one at which the robot can turn, that; the way to it is
/// found later.
std::optional<grid::CellIndex> PlanningState::Impl::reachable_cell(const types::Vector2& p_map) {
  constexpr double kNear_m = 0.5, kBeside_m = 2.0;
  search.settle(kBeside_m);
  const grid::CellIndex cell = map.cell_at(p_map);
  const auto stay = grid::nearest_to_stay_at(map, field, cell, kNear_m);
  return stay ? stay : grid::nearest_reachable(map, field, cell, kNear_m);
}

void PlanningState::Impl::aim(const PlanningInput& in, const types::Vector2& p_map, double reached_m,
                              Activity underway) {
  if (!goal) {
    goals::Goal place;
    place.p_map = p_map;
    set_out(in, place);
  }
  const types::Vector2 here = T_map_base.se2().translation();
  const bool arrived = in.control->goal_id == goal_id && in.control->mode == ControlMode::kArrived;
  if ((p_map - here).norm() <= reached_m || (arrived && (p_map - here).norm() <= 2.0 * reached_m + 0.1))
    return end(Activity::kDone, "arrived");
  if (in.control->goal_id == goal_id && in.control->mode == ControlMode::kStuck) {
    block_ahead(in);
    ++goal_id;  // another way, and control begins anew
  }
  if (standing_for(in) > 4 * kStandstill) return end(Activity::kFailed, "no progress for 100 s");
  const auto cell = reachable_cell(p_map);
  has_target = cell.has_value();
  if (cell) target = *cell;
  activity = underway;
  if (cell) return;
  reason = "no way there just now";
  (void)forget_unseen(in);
  too_tight.clear();  // what was too tight to explore may be the only way home
}

void PlanningState::Impl::go_home(const PlanningInput& in, std::string why) {
  reason = std::move(why);
  const bool with_others = comes_home_with_others(in);
  const bool stuck = in.control->goal_id == goal_id && in.control->mode == ControlMode::kStuck;
  const double usual_m = with_others ? params.team_home_reached_m : params.home_reached_m;
  const double reached_m = stuck ? std::max(usual_m, kHomeWhenStuck_m) : usual_m;
  aim(in, home_of(in), reached_m, Activity::kReturning);
  if (activity == Activity::kDone && with_others) return wait_at_home(in);
  if (activity != Activity::kDone || !returning) return;
  if (cut_short)
    end(Activity::kFailed, return_reason + ": came home");
  else
    reason = return_reason;
}

void PlanningState::Impl::go_to(const PlanningInput& in) {
  reason = "on the operator's order";
  aim(in, mission.target, params.home_reached_m, Activity::kGoingTo);
}

}  // namespace topo::pipeline

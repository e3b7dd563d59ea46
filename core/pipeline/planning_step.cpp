// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/planning_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/grid/nearest_reachable.hpp"
#include "core/pipeline/planning_state.hpp"
#include "core/travel/path.hpp"
#include "core/types/battery.hpp"

namespace topo::pipeline {
namespace {

constexpr types::Duration kTrackedAgeMax = std::chrono::seconds(1);
constexpr types::Duration kControlAgeMax = std::chrono::milliseconds(500);
// So long the odometry alone is believed. At full speed it is 1.4 m of way: a tenth of that in slipping
// wheels has the robot 0.14 m beside where it believes to be, which is about the room that a door of 0.8 m
// leaves on either side. A person who fills the view is gone sooner.
constexpr types::Duration kReckonedMax = std::chrono::seconds(2);
constexpr double kBesideMate_mps = 0.25;  // two of them, closing for a scan's age, are still apart
// A decision holds this long unless something happens: 1 m at full speed, and the next keyframe or two.
constexpr types::Duration kDecisionHolds = std::chrono::milliseconds(1500);
constexpr double kOffRoute_m = 0.4;
constexpr double kCorrection_m = 0.10, kCorrection_rad = 0.03;  // so bent, a route is another one
constexpr double kBent_m = 0.005, kBent_rad = 0.005;            // a slip moves no keyframe at all
constexpr double kNear_m = 6.0;                                 // farther ways are found by the coarse map

/// Why nobody knows where the robot is; null when its place is known in this very period.
const char* place_missing(const PlanningInput& in, types::Stamp matched) {
  if (in.map == nullptr || in.map->keyframes.empty()) return "no map yet";
  if (in.control == nullptr || in.now - in.control->stamp > kControlAgeMax)
    return "no message from the base thread";
  if (!in.control->base_ready) return "the base is not ready";
  if (in.tracked == nullptr || in.now - in.tracked->stamp > kTrackedAgeMax)
    return "no scan was placed lately: the robot does not know where it is";
  if (in.now - matched > kReckonedMax) return "lost: no scan has matched the map for two seconds";
  return nullptr;
}

}  // namespace

bool NewestKeyframe::is_bent(const MapSnapshot& now, double by_m, double by_rad) const {
  if (number >= now.keyframes.size() || now.keyframes[number].stamp != keyframe.stamp) return true;
  const types::Se2 change = keyframe.T_map_base.se2().inverse() * now.keyframes[number].T_map_base.se2();
  return change.translation().norm() > by_m || std::abs(change.theta_rad) > by_rad;
}

PlanningState::PlanningState(const PlannerParams& params) : impl_(std::make_unique<Impl>(params)) {}
PlanningState::~PlanningState() = default;

void PlanningState::Impl::take_mission(const PlanningInput& in) {
  if (in.mission.number == mission.number) {
    mission.paused = in.mission.paused;
    return;
  }
  mission = in.mission;
  ended = mission.order == Order::kStand;
  activity = Activity::kIdle;
  reason = ended ? "standing, as told" : "";
  second_phase = returning = cut_short = at_home = seeks_contact = false;
  contact.forget();
  idle_since = {};
  room.reset();
  ignore_room_until = {};
  home.reset();
  bids.clear();
  resumed = caught = 0;
  nothing_since = {};
  battery_low = false;
  goal.reset();
  has_target = false;
  deferred.clear();
  too_tight.clear();
  looks.begin(in.now);
  looks_meanwhile = false;
  goal_ways.doubt();
  open_goals.clear();
  route.clear();
  thought = {};
  if (mission.order == Order::kExplore) {
    decisions.clear();
    goals_issued = decisions_made = clusters_sum = goals_sum = 0;
  }
}

void PlanningState::Impl::locate(const PlanningInput& in) {
  const bool newer = in.tracked != nullptr && in.tracked->revision == in.map->revision;
  T_map_odom = newer ? in.tracked->T_map_odom : in.map->T_map_odom;
  T_map_base = T_map_odom * in.control->odometry.T_odom_base;
  // The start moves with the map: it is where the first keyframe was made.
  T_map_start = in.map->keyframes.front().T_map_base;
}

void PlanningState::Impl::watch_bends(const PlanningInput& in) {
  if (latest.is_bent(*in.map, kBent_m, kBent_rad)) ++bends;
  latest = NewestKeyframe(*in.map);
}

void PlanningState::Impl::watch_battery(const PlanningInput& in) {
  const ControlReport& c = *in.control;
  const bool low =
      types::is_battery_low(c.battery_v, c.state_of_charge, {params.battery_home_v, params.charge_home});
  if (!low) battery_low_since = {};
  if (low && battery_low_since == types::Stamp{}) battery_low_since = in.now;
  // It stays low for the mission: a battery that is spared recovers a little, and is as empty as before.
  battery_low = battery_low || (low && in.now - battery_low_since >= types::kBatteryLowFor);
}

void PlanningState::Impl::decide(const PlanningInput& in) {
  if (!returning) home.reset();
  at_home = false;
  if (in.team != nullptr && make_room(in)) return;
  if (battery_low && mission.order != Order::kHome && !returning) {
    returning = cut_short = true;
    return_reason = "the battery is low";
    goal.reset();
    note(in, T_map_start.se2().translation(), "home: the battery is low");
  }
  if (returning && (battery_low || mission.order != Order::kExplore)) return go_home(in, return_reason);
  switch (mission.order) {
    case Order::kExplore:
      return explore(in);
    case Order::kHome:
      return go_home(in, "on the operator's order");
    case Order::kGoTo:
      return go_to(in);
    case Order::kStand:
      return;
  }
}

/// Is the last decision still good: nothing happened, and nothing stands in the way?
bool PlanningState::Impl::route_holds(const PlanningInput& in) const {
  if (!has_target || !goal || route.size() < 2) return false;
  const types::Duration since = in.now - thought;
  const bool may_be_quiet = since < params.quiet_decision_holds;
  if (since >= kDecisionHolds && (!may_be_quiet || has_changed(in) || !mates_claim_the_same(in)))
    return false;
  if (battery_low && !returning) return false;
  if (in.team != nullptr && right_of_way_changed(in)) return false;
  if (seeks_contact && !contact.lost_at(in.now)) return false;
  if (in.control->mode == ControlMode::kStuck || in.control->mode == ControlMode::kArrived) return false;
  if (newest.is_bent(*in.map, kCorrection_m, kCorrection_rad)) return false;
  const types::Vector2 here = T_map_base.se2().translation();
  if ((route.back() - here).norm() <= params.goal_reached_m) return false;
  const std::size_t from = travel::nearest_point(route, here);
  if ((route[from] - here).norm() > kOffRoute_m) return false;
  const auto ahead = static_cast<std::ptrdiff_t>(std::min(route.size(), from + travel::kNearPoints));
  const double closed_m = params.travel.radius_m - map.resolution_m;
  for (const types::Vector2& obstacle : seen_now(in)) {
    if ((obstacle - here).norm() <= closed_m) continue;  // there already
    const bool in_the_way = std::any_of(
        route.begin() + static_cast<std::ptrdiff_t>(from), route.begin() + ahead,
        [&](const types::Vector2& p) { return (p - obstacle).squaredNorm() < closed_m * closed_m; });
    if (in_the_way) return false;
  }
  return true;
}

void PlanningState::Impl::trim_route() {
  const auto passed =
      static_cast<std::ptrdiff_t>(travel::nearest_point(route, T_map_base.se2().translation()));
  route.erase(route.begin(), route.begin() + passed);
}

/// The way to the target, as cells; what is far is not searched for over all of the building.
std::vector<grid::CellIndex> PlanningState::Impl::cells_to_target() {
  const auto is_found = [&] {
    return static_cast<double>(field.cost_m[map.index(target)]) < search.settled_m();
  };
  search.settle(kNear_m);
  if (!is_found()) {
    need_coarse();
    std::vector<grid::CellIndex> cells =
        far_route.find(map, travel_clearance_m, coarse, coarse_field, field.start, target, params.travel);
    if (!cells.empty()) return cells;
    search.settle(HUGE_VAL);
  }
  return grid::route_to(map, field, target);
}

void PlanningState::Impl::find_route() {
  route.clear();
  if (ended || !has_target) return;
  route = travel::smooth_path(map, travel_clearance_m, cells_to_target(), params.travel.preferred_m);
}

/// Everything anew: map, analysis, goal, route.
void PlanningState::Impl::think(const PlanningInput& in) {
  thought = in.now;
  thought_cells = in.map->changed_cells;
  claims_then = claims_of_mates(in);
  if (newest.is_bent(*in.map, kCorrection_m, kCorrection_rad)) goal_ways.doubt();
  newest = NewestKeyframe(*in.map);
  const auto told = [&](PlanningStage stage) {
    if (in.done) in.done(stage);
  };
  refresh_map(in);
  told(PlanningStage::kMap);
  refresh_analysis(in);
  told(PlanningStage::kAnalysis);
  if (mission.paused) thought = {};  // whoever goes on thinks first: a route from before is worth nothing
  if (ended || mission.paused) return;
  refresh_travel(in);
  told(PlanningStage::kTravel);
  decide(in);
  told(PlanningStage::kDecision);
  find_route();
  told(PlanningStage::kRoute);
}

void PlanningState::Impl::make_plan(const PlanningInput& in, Plan& plan) const {
  plan.stamp = in.now;
  plan.sequence = sequence;
  plan.goal_id = goal_id;
  plan.activity = activity;
  plan.T_map_odom = T_map_odom;
  plan.bends = bends;
  plan.located = located;
  if (ended || mission.paused || !has_target || route.size() < 2) return;
  plan.moving = true;
  if (in.team != nullptr && slows_for_mate(in)) plan.v_max_mps = kBesideMate_mps;
  plan.mate_behind = in.team != nullptr && is_mate_behind(in);
  put_path(route, T_map_odom, plan);
}

std::unique_ptr<PlanningReport> PlanningState::Impl::make_report(const PlanningInput& in) const {
  auto report = std::make_unique<PlanningReport>();
  report->sequence = sequence;
  report->stamp = in.now;
  report->activity = activity;
  report->reason = hindrance.empty() ? reason : hindrance;
  report->mission = mission.number;
  report->mission_ended = ended;
  report->second_phase = second_phase;
  report->T_map_base = T_map_base;
  report->T_map_start = T_map_start;
  report->known_m2 = known_m2;
  report->analysis = analysis;
  report->open_goals = open_goals;
  report->deferred = deferred.held(in.now);
  report->decisions = decisions;
  report->goal = goal;
  report->route_map = route;
  report->frontier_clusters = clusters;
  report->goals_issued = goals_issued;
  report->decisions_made = decisions_made;
  report->clusters_sum = clusters_sum;
  report->goals_sum = goals_sum;
  return report;
}

/// Nothing can be planned; the mission is kept.
void PlanningState::Impl::stand(const PlanningInput& in, const char* why) {
  if (!ended) activity = Activity::kThinking;
  hindrance = why;
  has_target = false;
  last_progress = in.now;
}

PlanningOutput PlanningState::Impl::step(const PlanningInput& in) {
  ++sequence;
  hindrance.clear();
  take_mission(in);
  if (in.team != nullptr) hear(in);
  if (in.tracked != nullptr && in.tracked->matched) matched = in.tracked->stamp;
  const char* unknown = place_missing(in, matched);
  located = unknown == nullptr;
  if (located) locate(in);
  if (located) watch_bends(in);
  if (!located) {
    stand(in, unknown);
  } else if (in.control->estop_latched) {
    stand(in, "emergency stop, to be cleared by the operator");
  } else {
    watch_battery(in);
    remember_echoes(in);
    remember_touches(in);
    if (mission.paused && !ended) {
      activity = Activity::kPaused;
      reason = "paused by the operator";
      last_progress = in.now;
    }
    if (!mission.paused && route_holds(in))
      trim_route();
    else
      think(in);
  }
  PlanningOutput out;
  make_plan(in, out.plan);
  out.report = make_report(in);
  if (in.team != nullptr) {
    ++messages;
    out.message = make_message(in);
  }
  return out;
}

PlanningOutput planning_step(PlanningState& state, const PlanningInput& input) {
  return state.impl_->step(input);
}

types::Status check_target(const analysis::Analysis& analysis, const PlannerParams& params,
                           const types::Vector2& from, const types::Vector2& target) {
  using types::Errc;
  if (!types::allows(params.area, target))
    return types::fail(Errc::kInvalidInput, "the target is outside of the configured area");
  const grid::DenseMap& map = analysis.map;
  const grid::CellIndex cell = map.cell_at(target);
  switch (map.state(cell)) {
    case grid::CellState::kUnknown:
      return types::fail(Errc::kInvalidInput, "the target is in unknown space");
    case grid::CellState::kOccupied:
      return types::fail(Errc::kInvalidInput, "something stands at the target");
    case grid::CellState::kFree:
      break;
  }
  const std::vector<float> clearance_m = analysis::clearance_of(analysis);
  const grid::TravelField field = grid::travel_field(map, clearance_m, map.cell_at(from), params.travel);
  if (!grid::nearest_to_stay_at(map, field, cell, 0.25))
    return types::fail(Errc::kInvalidInput, "no way that is wide enough for the robot leads to the target");
  return {};
}

std::string_view to_text(Finish finish) { return finish == Finish::kEssential ? "essential" : "complete"; }

}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/planning_step.hpp"

#include <utility>

#include "core/grid/distance.hpp"
#include "core/pipeline/path.hpp"
#include "core/pipeline/planning_state.hpp"

namespace topo::pipeline {
namespace {

constexpr types::Duration kTrackedAgeMax = std::chrono::seconds(1);
constexpr types::Duration kControlAgeMax = std::chrono::milliseconds(500);
constexpr types::Duration kBatteryLowFor = std::chrono::seconds(10);

/// Why nothing can be planned; null when it can.
const char* missing(const PlanningInput& in) {
  if (in.map == nullptr || in.map->keyframes.empty()) return "no map yet";
  if (in.control == nullptr || in.now - in.control->stamp > kControlAgeMax)
    return "no word from the base thread";
  if (!in.control->base_ready) return "the base is not ready";
  if (in.tracked == nullptr || in.now - in.tracked->stamp > kTrackedAgeMax)
    return "no scan was matched lately: the robot does not know where it is";
  if (in.control->estop_latched) return "emergency stop, to be cleared by the operator";
  return nullptr;
}

}  // namespace

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
  second_phase = returning = false;
  goal.reset();
  has_target = false;
  given_up.clear();
  blocked.clear();
  open_goals.clear();
  route.clear();
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

void PlanningState::Impl::watch_battery(const PlanningInput& in) {
  const ControlReport& c = *in.control;
  const bool low = (c.battery_v > 0.0F && static_cast<double>(c.battery_v) < params.battery_home_v) ||
                   (c.state_of_charge >= 0.0F && static_cast<double>(c.state_of_charge) < params.charge_home);
  if (!low) battery_low_since = {};
  if (low && battery_low_since == types::Stamp{}) battery_low_since = in.now;
  battery_low = low && in.now - battery_low_since >= kBatteryLowFor;
}

void PlanningState::Impl::decide(const PlanningInput& in) {
  if (battery_low && mission.order != Order::kHome && !returning) {
    returning = true;
    return_reason = "the battery is low";
    goal.reset();
    note(in, T_map_start.se2().translation(), "home: the battery is low");
  }
  if (returning) return go_home(in, return_reason);
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

void PlanningState::Impl::make_plan(const PlanningInput& in, Plan& plan) {
  plan.stamp = in.now;
  plan.sequence = sequence;
  plan.goal_id = goal_id;
  plan.activity = activity;
  plan.T_map_odom = T_map_odom;
  route.clear();
  if (ended || mission.paused || !has_target) return;
  const auto cells = grid::route_to(map, field, target);
  route = smooth_path(map, travel_clearance_m, cells, params.travel.preferred_m);
  plan.moving = route.size() > 1;
  put_path(route, T_map_odom, plan);
}

std::unique_ptr<PlanningReport> PlanningState::Impl::make_report(const PlanningInput& in) const {
  auto report = std::make_unique<PlanningReport>();
  report->sequence = sequence;
  report->stamp = in.now;
  report->activity = activity;
  report->reason = reason;
  report->mission = mission.number;
  report->mission_ended = ended;
  report->second_phase = second_phase;
  report->T_map_base = T_map_base;
  report->T_map_start = T_map_start;
  report->known_m2 = known_m2;
  report->analysis = analysis;
  report->open_goals = open_goals;
  report->given_up = given_up.list();
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

PlanningOutput PlanningState::Impl::step(const PlanningInput& in) {
  ++sequence;
  PlanningOutput out;
  take_mission(in);
  if (const char* what = missing(in); what != nullptr) {
    if (!ended) activity = Activity::kThinking;
    reason = what;
    has_target = false;
    last_progress = in.now;
    out.plan.stamp = in.now;
    out.plan.sequence = sequence;
    out.plan.goal_id = goal_id;
    out.plan.activity = activity;
  } else {
    locate(in);
    watch_battery(in);
    refresh_map(in);
    refresh_analysis(in);
    if (!ended && !mission.paused) {
      refresh_travel(in);
      decide(in);
    } else if (mission.paused && !ended) {
      last_progress = in.now;
      activity = Activity::kPaused;
      reason = "paused by the operator";
    }
    make_plan(in, out.plan);
  }
  out.report = make_report(in);
  return out;
}

PlanningOutput planning_step(PlanningState& state, const PlanningInput& input) {
  return state.impl_->step(input);
}

types::Status check_target(const Analysis& analysis, const PlannerParams& params, const types::Vector2& from,
                           const types::Vector2& target) {
  using types::Errc;
  if (!motion::allows(params.area, target))
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
  const grid::TravelField field =
      grid::travel_field(map, analysis.clearance_m, map.cell_at(from), params.travel);
  if (!grid::nearest_reachable(map, field, cell, 0.25))
    return types::fail(Errc::kInvalidInput, "no way that is wide enough for the robot leads to the target");
  return {};
}

std::string_view to_text(Strategy strategy) {
  return strategy == Strategy::kTopometric ? "topometric" : "nearest_frontier";
}

std::string_view to_text(Finish finish) { return finish == Finish::kEssential ? "essential" : "complete"; }

}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/robot_run.hpp"

#include <algorithm>
#include <cmath>

#include "tests/bench/topobench/stopwatch.hpp"

namespace topo::bench {
namespace {

using pipeline::Activity;

constexpr sim::SimTime kControlPeriod = std::chrono::milliseconds(50);
constexpr sim::SimTime kSparseControlPeriod = std::chrono::milliseconds(100);  // two looks at one scan
constexpr sim::SimTime kPlanningPeriod = std::chrono::milliseconds(400);
constexpr sim::SimTime kSparsePlanningPeriod = std::chrono::milliseconds(800);  // a plan is good for a second

}  // namespace

RobotRun::RobotRun(Plant& plant, RobotMind& mind, const RunSetup& setup, RunHooks& hooks, TeamNode* node,
                   sim::SimTime begin)
    : plant_(plant), mind_(mind), setup_(setup), hooks_(hooks), node_(node), begin_(begin) {}

void RobotRun::tick() {
  readings_.clear();
  {
    const Stopwatch watch(result_.spent.simulation_s);
    plant_.tick(readings_);
  }
  hooks_.readings(readings_);
  {
    const Stopwatch watch(result_.spent.mapping_s);
    take_readings();
  }
  const sim::SimTime now = plant_.now();
  if (is_due(now, control_period())) control(types::Stamp{now});
  if (is_due(now, planning_period())) plan(types::Stamp{now});
}

void RobotRun::take_readings() {
  if (node_ == nullptr) return mind_.take(readings_, readings_);
  for_map_ = readings_;
  node_->mask_mates(for_map_);
  mind_.take(readings_, for_map_);
}

sim::SimTime RobotRun::control_period() const {
  return setup_.fidelity == Fidelity::kFull ? kControlPeriod : kSparseControlPeriod;
}

sim::SimTime RobotRun::planning_period() const {
  return setup_.fidelity == Fidelity::kFull ? kPlanningPeriod : kSparsePlanningPeriod;
}

void RobotRun::control(types::Stamp now) {
  const Stopwatch watch(result_.spent.control_s);
  const pipeline::ControlOutput& output = mind_.control(now);
  plant_.command(output.command);
  note(output.report.plausibility);
  note_time(output.report);
  hooks_.commanded(output);
}

void RobotRun::plan(types::Stamp now) {
  pipeline::Mission mission;
  if (now >= types::Stamp{begin_}) {
    mission.number = 1;
    mission.order = pipeline::Order::kExplore;
  }
  const Stopwatch watch(result_.spent.planning_s);
  const pipeline::TeamInput team = node_ != nullptr ? node_->heard() : pipeline::TeamInput{};
  const double begin_s = thread_cpu_seconds();
  double stage_s = begin_s;
  const auto done = [&](pipeline::PlanningStage stage) {
    const double now_s = thread_cpu_seconds();
    if (stage == pipeline::PlanningStage::kDecision) result_.decision_ms.push_back((now_s - stage_s) * 1e3);
    if (stage == pipeline::PlanningStage::kRoute) result_.planning_ms.push_back((now_s - begin_s) * 1e3);
    stage_s = now_s;
  };
  const pipeline::PlanningOutput& output = mind_.plan(now, mission, team, done);
  if (node_ != nullptr) node_->say(output.message);
  note(*output.report, output.plan);
  hooks_.planned(output);
}

void RobotRun::note(const plausibility::Opinion& opinion) {
  for (std::size_t i = 0; i < plausibility::kDoubts; ++i)
    result_.doubts[i] += opinion.doubts.test(i) && !doubts_.test(i) ? 1 : 0;
  doubts_ = opinion.doubts;
  result_.worst_lag_s = std::max(result_.worst_lag_s, types::to_seconds(opinion.lag));
}

void RobotRun::note(const pipeline::PlanningReport& report, const pipeline::Plan& plan) {
  result_.goals_issued = report.goals_issued;
  result_.clusters_sum = report.clusters_sum;
  result_.goals_sum = report.goals_sum;
  result_.decisions_made = report.decisions_made;
  result_.activity = report.activity;
  result_.reason = report.reason;
  result_.mission_ended = report.mission == 1 && report.mission_ended;
  for (const pipeline::Decision& decision : report.decisions) {
    if (decision.stamp <= last_decision_) continue;
    result_.decisions.push_back(decision);
    result_.goals_left += decision.text.starts_with("left ") ? 1U : 0U;
  }
  if (!report.decisions.empty()) last_decision_ = report.decisions.back().stamp;
  if (plan.goal_id != last_goal_ && report.goal)
    result_.goals.push_back({types::to_seconds(report.stamp), report.goal->p_map});
  last_goal_ = plan.goal_id;
}

void RobotRun::note_time(const pipeline::ControlReport& report) {
  if (plant_.now() < begin_ || is_over()) return;
  const bool has_way = result_.activity == Activity::kExploring || result_.activity == Activity::kReturning ||
                       result_.activity == Activity::kGoingTo;
  book_.add({types::to_seconds(control_period()), plant_.body().true_twist(),
             setup_.mind.control.limits.v_max_mps, report.mode, report.reason, has_way});
}

void RobotRun::note_way(const RunResult& known) {
  for (std::size_t i = 0; i < RunResult::kShares.size(); ++i) {
    if (known.reached_s[i] && !result_.way_m[i]) result_.way_m[i] = plant_.body().path_m();
  }
}

void RobotRun::note_pose() {
  // Both at the moment that the newest dead reckoning tells of.
  result_.truth.push_back(plant_.body().pose_at(mind_.odometry().stamp.time_since_epoch()));
  const auto& tracked = mind_.source().tracked();
  result_.estimate.push_back((tracked.T_map_odom * mind_.odometry().T_odom_base).se2());
}

bool RobotRun::is_over() const {
  const types::Twist2 twist = plant_.body().true_twist();
  return result_.mission_ended && twist.v_mps == 0.0 && twist.omega_radps == 0.0;
}

void RobotRun::finish(std::span<const sim::Se2> starts) {
  const sim::Se2& end = plant_.body().truth();
  result_.end_s = types::to_seconds(plant_.now());
  result_.home_distance_m = HUGE_VAL;
  for (const sim::Se2& start : starts)
    result_.home_distance_m =
        std::min(result_.home_distance_m, (end.translation() - start.translation()).norm());
  result_.home = result_.home_distance_m <= kHome_m;
  if (result_.home && result_.activity == Activity::kDone) result_.home_s = result_.end_s;
  result_.distance_m = plant_.body().path_m();
  result_.time = book_.spent();
  result_.collisions = plant_.body().collisions();
}

void note_coverage(const Coverage& coverage, double now_s, RunResult& result) {
  const double share = coverage.known_fraction(), free = coverage.free_fraction();
  result.coverage.emplace_back(now_s, share);
  for (std::size_t i = 0; i < RunResult::kShares.size(); ++i) {
    if (!result.reached_s[i] && share >= RunResult::kShares[i]) result.reached_s[i] = now_s;
    if (!result.free_s[i] && free >= RunResult::kShares[i]) result.free_s[i] = now_s;
  }
}

}  // namespace topo::bench

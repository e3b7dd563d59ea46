// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/explore_run.hpp"

#include <chrono>
#include <cmath>
#include <ctime>

#include "daemon/config/configuration.hpp"

namespace topo::bench {
namespace {

using WallClock = std::chrono::steady_clock;
using pipeline::Activity;

constexpr sim::SimTime kControlPeriod = std::chrono::milliseconds(50);
constexpr sim::SimTime kPlanningPeriod = std::chrono::milliseconds(400);
constexpr sim::SimTime kSparsePlanningPeriod = std::chrono::milliseconds(800);  // a plan is good for a second
constexpr sim::SimTime kMeasurePeriod = std::chrono::seconds(1);

/// Adds the time since its making to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum_s) : sum_s_(sum_s), begin_(WallClock::now()) {}
  ~Stopwatch() { sum_s_ += elapsed_s(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  [[nodiscard]] double elapsed_s() const {
    return std::chrono::duration<double>(WallClock::now() - begin_).count();
  }

 private:
  double& sum_s_;
  WallClock::time_point begin_;
};

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

bool is_due(sim::SimTime now, sim::SimTime period) { return now % period == sim::SimTime{0}; }

class Run {
 public:
  Run(Plant& plant, RobotMind& mind, const RunSetup& setup, const sim::Raster& visible, RunHooks& hooks)
      : plant_(plant),
        mind_(mind),
        setup_(setup),
        hooks_(hooks),
        coverage_(visible, setup.plant.start, setup.mind.mapping.grid.resolution_m) {
    mission_.number = 1;
    mission_.order = pipeline::Order::kExplore;
  }

  RunResult run() {
    double wall_s = 0.0;
    const double cpu_s = cpu_seconds();
    {
      const Stopwatch watch(wall_s);
      const sim::SimTime limit = types::from_seconds(setup_.limit_s);
      while (plant_.now() < limit && !is_over()) step();
    }
    result_.wall_s = wall_s;
    result_.cpu_s = cpu_seconds() - cpu_s;
    finish();
    return std::move(result_);
  }

 private:
  void step() {
    readings_.clear();
    {
      const Stopwatch watch(result_.spent.simulation_s);
      plant_.tick(readings_);
    }
    hooks_.readings(readings_);
    {
      const Stopwatch watch(result_.spent.mapping_s);
      mind_.take(readings_);
    }
    const sim::SimTime now = plant_.now();
    if (is_due(now, kControlPeriod)) control(types::Stamp{now});
    if (is_due(now, planning_period())) plan(types::Stamp{now});
    if (is_due(now, kMeasurePeriod)) measure();
    hooks_.ticked(plant_);
  }

  [[nodiscard]] sim::SimTime planning_period() const {
    return setup_.fidelity == Fidelity::kFull ? kPlanningPeriod : kSparsePlanningPeriod;
  }

  void control(types::Stamp now) {
    const Stopwatch watch(result_.spent.control_s);
    const pipeline::ControlOutput& output = mind_.control(now);
    plant_.command(output.command);
    hooks_.commanded(output);
  }

  void plan(types::Stamp now) {
    const Stopwatch watch(result_.spent.planning_s);
    const pipeline::PlanningOutput& output = mind_.plan(now, mission_);
    result_.decision_ms.push_back(watch.elapsed_s() * 1e3);
    note(*output.report, output.plan);
    hooks_.planned(output);
  }

  void note(const pipeline::PlanningReport& report, const pipeline::Plan& plan) {
    result_.goals_issued = report.goals_issued;
    result_.clusters_sum = report.clusters_sum;
    result_.goals_sum = report.goals_sum;
    result_.decisions_made = report.decisions_made;
    result_.activity = report.activity;
    result_.reason = report.reason;
    result_.mission_ended = report.mission_ended;
    for (const pipeline::Decision& decision : report.decisions) {
      if (decision.stamp > last_decision_) result_.decisions.push_back(decision);
    }
    if (!report.decisions.empty()) last_decision_ = report.decisions.back().stamp;
    if (plan.goal_id != last_goal_ && report.goal)
      result_.goals.push_back({types::to_seconds(report.stamp), report.goal->p_map});
    last_goal_ = plan.goal_id;
  }

  void measure() {
    const Stopwatch watch(result_.spent.measuring_s);
    coverage_.update(mind_.source().map().grid);
    const double now_s = types::to_seconds(plant_.now());
    const double share = coverage_.free_fraction();
    result_.coverage.emplace_back(now_s, share);
    for (std::size_t i = 0; i < RunResult::kShares.size(); ++i) {
      if (!result_.reached_s[i] && share >= RunResult::kShares[i]) result_.reached_s[i] = now_s;
      if (!result_.known_s[i] && coverage_.known_fraction() >= RunResult::kShares[i])
        result_.known_s[i] = now_s;
    }
    // Both at the moment that the newest dead reckoning tells of.
    result_.truth.push_back(plant_.body().pose_at(mind_.odometry().stamp.time_since_epoch()));
    const auto& tracked = mind_.source().tracked();
    result_.estimate.push_back((tracked.T_map_odom * mind_.odometry().T_odom_base).se2());
  }

  /// The mission has ended and the robot has come to a stand.
  [[nodiscard]] bool is_over() const {
    const types::Twist2 twist = plant_.body().true_twist();
    return result_.mission_ended && twist.v_mps == 0.0 && twist.omega_radps == 0.0;
  }

  void finish() {
    const sim::Se2& end = plant_.body().truth();
    result_.end_s = types::to_seconds(plant_.now());
    if (result_.coverage.empty() || result_.coverage.back().first != result_.end_s) measure();
    result_.home_distance_m = (end.translation() - setup_.plant.start.translation()).norm();
    result_.home = result_.home_distance_m <= kHome_m;
    if (result_.home && result_.activity == Activity::kDone) result_.home_s = result_.end_s;
    result_.distance_m = plant_.body().path_m();
    result_.collisions = plant_.body().collisions();
    result_.known_fraction = coverage_.known_fraction();
    result_.covered = coverage_.covered();
  }

  Plant& plant_;
  RobotMind& mind_;
  const RunSetup& setup_;
  RunHooks& hooks_;
  Coverage coverage_;
  pipeline::Mission mission_;
  Readings readings_;
  RunResult result_;
  types::Stamp last_decision_{};
  std::uint64_t last_goal_ = 0;
};

}  // namespace

RunResult run_exploration(Plant& plant, RobotMind& mind, const RunSetup& setup, const sim::Raster& visible,
                          RunHooks* hooks) {
  RunHooks nobody;
  return Run(plant, mind, setup, visible, hooks != nullptr ? *hooks : nobody).run();
}

types::Result<std::unique_ptr<Plant>> make_plant(sim::World world, const RunSetup& setup) {
  return setup.fidelity == Fidelity::kFull ? make_full_plant(std::move(world), setup.plant)
                                           : make_sparse_plant(std::move(world), setup.plant);
}

std::unique_ptr<RobotMind> make_mind(const RunSetup& setup) {
  return std::make_unique<RobotMind>(setup.mind,
                                     setup.fidelity == Fidelity::kFull
                                         ? make_slam_source(setup.mind.mapping, setup.closure_delay_scans)
                                         : make_posed_source(setup.mind.mapping));
}

RunSetup default_setup(const sim::Se2& start, std::uint64_t seed, Fidelity fidelity) {
  daemon::Configuration configuration;  // the simulated robot's scanners are where its usual file has them
  configuration.front.x_m = 0.021;
  configuration.coronal.x_m = 0.10;
  configuration.coronal.z_m = 0.40;
  RunSetup setup;
  setup.fidelity = fidelity;
  MindSetup& mind = setup.mind;
  // The daemon's own conversions, so that a run here is a run of the daemon.
  mind.mapping = daemon::mapper_params(configuration);
  mind.planner = daemon::planner_params(configuration);
  mind.control = daemon::control_setup(configuration);
  for (const sim::SonarMount& sonar : sim::RobotModel::p3dx().sonars)
    mind.T_base_sonar.push_back({sonar.x_m, sonar.y_m, sonar.heading_rad});
  setup.plant.start = start;
  setup.plant.mapping = mind.mapping;
  setup.plant.limits = mind.control.limits;
  setup.plant.firmware_watchdog = mind.firmware_watchdog;
  setup.plant.seed = seed;
  return setup;
}

}  // namespace topo::bench

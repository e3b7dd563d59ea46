// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/explore_run.hpp"

#include "daemon/config/configuration.hpp"
#include "tests/bench/topobench/explore/robot_run.hpp"
#include "tests/bench/topobench/stopwatch.hpp"

namespace topo::bench {
namespace {

// A way through known space is thought over more seldom than in the daemon, whatever the strategy: thinking
// is most of what such a run costs. Some gaps are passed by that the daemon would have taken on its way.
constexpr types::Duration kSparseQuietDecision = std::chrono::seconds(4);

class Run {
 public:
  Run(Plant& plant, RobotMind& mind, const RunSetup& setup, const sim::Raster& visible, RunHooks& hooks)
      : robot_(plant, mind, setup, hooks),
        setup_(setup),
        hooks_(hooks),
        coverage_(visible, setup.plant.start, setup.mind.mapping.grid.resolution_m) {}

  RunResult run() {
    RunResult& result = robot_.result();
    double wall_s = 0.0;
    const double cpu_s = cpu_seconds();
    {
      const Stopwatch watch(wall_s);
      const sim::SimTime limit = types::from_seconds(setup_.limit_s);
      while (robot_.plant().now() < limit && !robot_.is_over()) step();
    }
    result.wall_s = wall_s;
    result.cpu_s = cpu_seconds() - cpu_s;
    robot_.finish({&setup_.plant.start, 1});
    if (result.coverage.empty() || result.coverage.back().first != result.end_s) measure();
    result.free_fraction = coverage_.free_fraction();
    result.covered = coverage_.covered();
    return std::move(result);
  }

 private:
  void step() {
    robot_.tick();
    if (is_due(robot_.plant().now(), kMeasurePeriod)) measure();
    hooks_.ticked(robot_.plant());
  }

  void measure() {
    const Stopwatch watch(robot_.result().spent.measuring_s);
    coverage_.update(robot_.mind().source().map().grid);
    note_coverage(coverage_, types::to_seconds(robot_.plant().now()), robot_.result());
    robot_.note_pose();
    robot_.note_way(robot_.result());
  }

  RobotRun robot_;
  const RunSetup& setup_;
  RunHooks& hooks_;
  Coverage coverage_;
};

}  // namespace

RunResult run_exploration(Plant& plant, RobotMind& mind, const RunSetup& setup, const sim::Raster& visible,
                          RunHooks* hooks) {
  RunHooks nobody;
  return Run(plant, mind, setup, visible, hooks != nullptr ? *hooks : nobody).run();
}

types::Result<std::unique_ptr<Plant>> make_plant(sim::World world, const RunSetup& setup) {
  return setup.fidelity == Fidelity::kFull
             ? make_full_plant(std::move(world), setup.plant)
             : make_sparse_plant(std::make_shared<sim::World>(std::move(world)), setup.plant);
}

std::unique_ptr<RobotMind> make_mind(const RunSetup& setup) {
  return std::make_unique<RobotMind>(setup.mind,
                                     setup.fidelity == Fidelity::kFull
                                         ? make_slam_source(setup.mind.mapping, setup.closure_delay_scans)
                                         : make_posed_source(setup.mind.mapping));
}

RunSetup default_setup(const sim::Se2& start, std::uint64_t seed, Fidelity fidelity, double v_max_mps) {
  daemon::Configuration configuration;  // the simulated robot's scanners are where its usual file has them
  configuration.front.x_m = 0.021;
  configuration.coronal.x_m = 0.10;
  configuration.coronal.z_m = 0.40;
  configuration.base.v_max_mps = v_max_mps;
  return configured_setup(configuration, start, seed, fidelity);
}

RunSetup configured_setup(const daemon::Configuration& configuration, const sim::Se2& start,
                          std::uint64_t seed, Fidelity fidelity) {
  RunSetup setup;
  setup.fidelity = fidelity;
  MindSetup& mind = setup.mind;
  // The daemon's own conversions, so that a run here is a run of the daemon.
  mind.mapping = daemon::mapper_params(configuration);
  mind.planner = daemon::planner_params(configuration);
  if (fidelity == Fidelity::kPlan) {
    mind.planner.coarse_analysis = true;
    mind.control_params.plausibility.picture.noiseless = true;  // the sparse scanner has no noise
    mind.planner.hold.quiet_decision_holds = kSparseQuietDecision;
  }
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

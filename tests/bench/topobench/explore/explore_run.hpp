// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "daemon/config/configuration.hpp"
#include "tests/bench/topobench/explore/coverage.hpp"
#include "tests/bench/topobench/explore/plant.hpp"
#include "tests/bench/topobench/explore/robot_mind.hpp"
#include "tests/bench/topobench/explore/time_book.hpp"
#include "tests/sim/area.hpp"

namespace topo::bench {

constexpr double kHome_m = 0.5;  ///< so near to its start a robot is back

enum class Fidelity { kFull, kPlan };

struct RunSetup {
  Fidelity fidelity = Fidelity::kFull;
  double limit_s = 1800.0;
  int closure_delay_scans = 20;  ///< half a second
  PlantSetup plant;
  MindSetup mind;
};

/// Looks on, and for tests puts other things in the way.
class RunHooks {
 public:
  virtual ~RunHooks() = default;
  /// Before the mind gets them; may be changed.
  virtual void readings(Readings& /*readings*/) {}
  virtual void planned(const pipeline::PlanningOutput& /*output*/) {}
  virtual void commanded(const pipeline::ControlOutput& /*output*/) {}
  virtual void ticked(Plant& /*plant*/) {}
};

/// Wall time that one part of the loop took.
struct Spent {
  double simulation_s = 0.0, mapping_s = 0.0, planning_s = 0.0, control_s = 0.0, measuring_s = 0.0;
};

struct IssuedGoal {
  double t_s = 0.0;
  types::Vector2 p_map{0.0, 0.0};
};

struct RunResult {
  static constexpr std::array<double, 4> kShares{0.50, 0.90, 0.95, 0.99};

  double end_s = 0.0;
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< says more than wall_s on a busy machine
  Spent spent;
  /// When kShares of the area were known, and when known as free, which the rim of the walls never is.
  std::array<std::optional<double>, kShares.size()> reached_s, free_s;
  std::optional<double> home_s;  ///< the mission done and the robot home
  bool home = false;             ///< at the end, within 0.5 m of its start
  double home_distance_m = 0.0;
  double distance_m = 0.0;
  /// Way of this robot (of a team's result: of the robot with the longest) when kShares were known.
  std::array<std::optional<double>, kShares.size()> way_m;
  TimeSpent time;                ///< of the mission, until it ended for this robot
  std::uint64_t goals_left = 0;  ///< for another, before they were reached, seen or given up
  std::uint64_t collisions = 0;
  std::vector<std::pair<double, double>> coverage;  ///< every second
  double free_fraction = 0.0;                       ///< known as free at the end
  std::vector<double> decision_ms;                  ///< goals and assignment of every decision, CPU time
  std::vector<double> planning_ms;  ///< all of the periods that decided: map, analysis, decision, route
  std::uint64_t goals_issued = 0, clusters_sum = 0, goals_sum = 0, decisions_made = 0;
  pipeline::Activity activity = pipeline::Activity::kIdle;
  std::string reason;
  bool mission_ended = false;
  /// How often each doubt of core/plausibility arose, in the order of plausibility::Doubt.
  std::array<int, plausibility::kDoubts> doubts{};
  double worst_lag_s = 0.0;
  std::vector<sim::Se2> truth;     ///< in the building, every second
  std::vector<sim::Se2> estimate;  ///< in map, the same moments
  std::vector<IssuedGoal> goals;
  std::vector<pipeline::Decision> decisions;
  sim::Raster covered;
};

/// One exploration from start to end in lock-step (DESIGN section 4: time comes in as a value). The same
/// arguments give the same result but for the wall times. `visible`: what counts as the building's area.
RunResult run_exploration(Plant& plant, RobotMind& mind, const RunSetup& setup, const sim::Raster& visible,
                          RunHooks* hooks = nullptr);

/// The parts for a run.
types::Result<std::unique_ptr<Plant>> make_plant(sim::World world, const RunSetup& setup);
std::unique_ptr<RobotMind> make_mind(const RunSetup& setup);

/// Everything as config/simulation.toml has it, but for base.v_max_mps.
RunSetup default_setup(const sim::Se2& start, std::uint64_t seed, Fidelity fidelity,
                       double v_max_mps = types::DriveLimits{}.v_max_mps);

/// The same with another configuration, of a robot that is as it says: but for its wheels, which are always a
/// little wrong.
RunSetup configured_setup(const daemon::Configuration& configuration, const sim::Se2& start,
                          std::uint64_t seed, Fidelity fidelity);

}  // namespace topo::bench

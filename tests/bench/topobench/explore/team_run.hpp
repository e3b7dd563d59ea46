// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tests/bench/topobench/explore/explore_run.hpp"
#include "tests/bench/topobench/explore/radio.hpp"
#include "tests/bench/topobench/judge/path_error.hpp"

namespace topo::bench {

struct TeamSetup {
  RunSetup run;  ///< of every robot; `plant.start` is the spot, and the origin of everybody's map
  int robots = 2;
  RadioParams radio;
  double entry_delay_s = 0.0;  ///< from one robot's beginning to the next one's
  bool starts_known = true;    ///< to the robots; fidelity "plan": always
};

/// One robot's map at the end, against where the robots truly were when they made its keyframes.
struct JoinedMap {
  std::size_t keyframes = 0;        ///< in the map
  std::size_t mates_keyframes = 0;  ///< of these, team-mates'
  std::optional<double> joined_s;   ///< when the first of those entered it
  PathError error;                  ///< of all, with the map laid on the building by the robot's true start
  PathError mates_error;            ///< of team-mates' alone
};

struct TeamResult {
  /// Of all together: coverage of what any of them knows, sums over robots, and when all were home.
  RunResult team;
  std::vector<RunResult> robots;  ///< without coverage
  std::vector<JoinedMap> maps;    ///< of each robot
  /// Of the area that any robot saw, the share that at least two saw themselves.
  double overlap = 0.0;
};

/// One exploration by several robots that enter at one spot of one building, in lock-step. The same arguments
/// give the same result but for the wall times. `hooks`: of the robots, as many as there are. `world` becomes
/// the building with the robots in it.
types::Result<TeamResult> run_team(const std::shared_ptr<sim::World>& world, const TeamSetup& setup,
                                   const sim::Raster& visible, std::span<RunHooks* const> hooks = {});

}  // namespace topo::bench

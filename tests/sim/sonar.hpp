// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "tests/sim/difficulty.hpp"
#include "tests/sim/random.hpp"
#include "tests/sim/robot_body.hpp"

namespace topo::sim {

/// One echo of one transducer.
struct SonarEcho {
  SimTime time{0};
  int index = 0;         ///< 0 to 15
  double range_m = 5.0;  ///< 0.15 to 5; 5: no echo
};

inline constexpr double kSonarRangeMin_m = 0.15;
inline constexpr double kSonarRangeMax_m = 5.0;
/// One transducer of each array of eight per cycle (PROTOCOLS section 6.3).
inline constexpr SimTime kSonarCycle{40'000'000};

/// Measurement of transducer `index` of a robot at `pose`: the nearest hit of a cone of rays (25 degrees
/// wide) whose angle of incidence reflects the echo back.
SonarEcho measure_sonar(const World& world, const RobotModel& model, const Se2& pose, int index, SimTime time,
                        const Difficulty& difficulty, Random& random, MovableId self);

}  // namespace topo::sim

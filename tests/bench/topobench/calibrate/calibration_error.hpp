// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tests/bench/topobench/calibrate/calibrated_robot.hpp"

namespace topo::bench {

/// One column of the table of errors, and what it must be.
struct ErrorKind {
  const char* name;
  const char* unit;
  double must;  ///< the greatest error; half of it is better
};

/// Yaw, place, wheels, track and delay by the bars; roll and place of the coronal scanner have none there.
inline constexpr std::array<ErrorKind, 7> kErrorKinds{{{"yaw", "deg", 0.3},
                                                       {"place", "mm", 10.0},
                                                       {"wheels", "%", 0.3},
                                                       {"track", "%", 0.5},
                                                       {"delay", "ms", 5.0},
                                                       {"coronal roll", "deg", 0.3},
                                                       {"coronal place", "mm", 20.0}}};
using Errors = std::array<double, kErrorKinds.size()>;

/// Of the configuration against the robot, in the order of kErrorKinds and without sign; of the wheels the
/// worse one.
Errors errors_of(const CalibratedRobot& robot);

}  // namespace topo::bench

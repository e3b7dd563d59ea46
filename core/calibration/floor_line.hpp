// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/calibration/still_picture.hpp"

namespace topo::calibration {

/// Where an upright scanner looks for the floor.
struct FloorParams {
  double height_min_m = 0.05, height_max_m = 1.6;  ///< of the scanner
  double aside_max_m = 4.0;                        ///< farther points are left out
  double tilt_max_rad = 0.35;                      ///< of the person from square to the floor
  double near_m = 0.04;                            ///< a point this near to a line is on it
  double covered_min_m = 0.6;  ///< of the line, by points: a line that only crosses walls has less
  double below_max = 0.03;     ///< share of the points that may lie below: mirrors, a step
  double side_min_m = 0.3;     ///< of that on each side of the foot
};

/// The floor in the frame of an upright scanner.
struct FloorLine {
  double down_rad = 0.0;   ///< angle of straight down
  double height_m = 0.0;   ///< of the scanner
  double covered_m = 0.0;  ///< of it, by what is seen
};

/// The floor, from a person standing on it: the floor is square to the person, one way or the other
/// (`axis_rad`), and of floor and ceiling it is the nearer, because scanners are mounted below half the
/// height of a room. Nothing where no straight line is seen to both sides.
[[nodiscard]] std::optional<FloorLine> find_floor(const StillPicture& picture, double axis_rad,
                                                  const FloorParams& params = {});

}  // namespace topo::calibration

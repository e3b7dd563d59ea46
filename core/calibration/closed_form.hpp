// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/calibration/intervals.hpp"

namespace topo::calibration {

/// Wheels and place of a scanner from motions of both, without a first guess: Censi, Franchi, Marchionni and
/// Oriolo, "Simultaneous calibration of odometry and sensor parameters for mobile robots", IEEE T-RO 29(2),
/// 2013. The turn of the scanner is linear in J21 = -left / track and J22 = right / track; with these the
/// displacements are linear in track, place, and cosine and sine of the yaw, whose squares sum to one, which
/// a Lagrange multiplier keeps. `use`: intervals that count. Nothing when the intervals leave a number open:
/// no turn, or no way.
[[nodiscard]] std::optional<RobotNumbers> closed_form(const WheelTrack& wheels,
                                                      std::span<const Interval> intervals,
                                                      const std::vector<bool>& use, double delay_s);

/// J21 and J22 of the paper alone, with the squares of what is left of each interval's turn; the same for a
/// delay.
struct Turning {
  double j21 = 0.0, j22 = 0.0;
  std::vector<double> square;  ///< infinite for intervals that do not count
};
[[nodiscard]] std::optional<Turning> fit_turning(const WheelTrack& wheels,
                                                 std::span<const Interval> intervals,
                                                 const std::vector<bool>& use, double delay_s);

}  // namespace topo::calibration

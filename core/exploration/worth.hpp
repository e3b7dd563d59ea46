// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/exploration/tour.hpp"

namespace topo::exploration {

/// What a goal gives, against the time that it takes (Finish::kWorth).
struct WorthParams {
  double rate_m2ps = 0.1;   ///< least area for a second of the robot's time: FinishRule
  double look_m2ps = 0.1;   ///< Finish::kComplete: the same for viewpoints of the final sweep
  double speed_mps = 0.5;   ///< at which a tour is driven: mean of explorations in drawn buildings
  double stop_s = 2.0;      ///< to brake, look and drive on, at each goal
  double beyond_m2 = 40.0;  ///< mean area behind an opening that certainly leads on: a room and a corridor
};

/// A goal that is left out of a tour.
struct LeftOut {
  std::size_t goal = 0;
  double gain_m2 = 0.0;
  double time_s = 0.0;  ///< that the tour of the goals that are left would be longer with it
};

/// The goals that a robot does better without: of the cheapest tour of all goals that ends at home, the
/// stretches that take more time than their area is worth, the worst first, until none is left. A stretch and
/// not a single goal, because the way to a far room is worth it for all that is there, or for nothing; the
/// whole tour is a stretch, too. In the end the goals that are worth their own detour from what is left are
/// taken back. `gain_m2`: of each goal; `home_m`: from the robot to its start.
std::vector<LeftOut> not_worth_it(const TourGoals& goals, std::span<const double> gain_m2, double home_m,
                                  const WorthParams& params);

}  // namespace topo::exploration

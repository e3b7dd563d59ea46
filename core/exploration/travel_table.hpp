// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/exploration/intent.hpp"
#include "core/exploration/params.hpp"
#include "core/exploration/tour.hpp"

namespace topo::exploration {

/// Costs of travel between the robot, its start and the nearest candidates of a decision.
struct TravelTable {
  /// The row in `goals` of each candidate; none of those beyond the nearest.
  std::vector<std::optional<std::size_t>> row;
  TourGoals goals{0};
  double home_m = 0.0;  ///< from the robot to its start; 0, as all ways there, when no route leads there now
};

/// The table of the TourParams::goals_max nearest candidates and the present one, which may be null. `start`,
/// in map: the robot's.
TravelTable travel_table(std::span<const Candidate> candidates, const Candidate* present,
                         const types::Vector2& start, Searches searches, const TourParams& params);

/// The rows of some goals, in this order.
TourGoals rows_of(const TourGoals& goals, std::span<const std::size_t> rows);

/// Expected area behind a goal, m2: for a pocket its own, for an opening that leads on `beyond_m2` times the
/// chance of that.
double expected_area_m2(const goals::Goal& goal, double beyond_m2, const TourParams& params);

}  // namespace topo::exploration

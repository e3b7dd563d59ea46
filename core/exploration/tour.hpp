// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace topo::exploration {

/// Goals that one robot has to visit, each once: costs of the routes, and expected information gains.
struct TourGoals {
  explicit TourGoals(std::size_t goals)
      : count(goals),
        from_start_m(goals, 0.0),
        to_home_m(goals, 0.0),
        worth(goals, 0.0),
        between_m(goals * goals, 0.0) {}

  [[nodiscard]] double& between(std::size_t a, std::size_t b) { return between_m[a * count + b]; }
  [[nodiscard]] double between(std::size_t a, std::size_t b) const { return between_m[a * count + b]; }

  std::size_t count;
  std::vector<double> from_start_m;  ///< from the robot's position
  std::vector<double> to_home_m;     ///< from each goal, when the tour ends there; else 0
  std::vector<double> worth;         ///< expected information gain in any unit, not negative
  std::vector<double> between_m;     ///< symmetric, row by row
};

/// Every goal once, in the order of the visits.
using Tour = std::vector<std::size_t>;

/// Cost of a tour in metres: `length_share` times its length, plus the rest times the mean distance driven
/// until a goal is reached, weighted by expected information gain. Length alone makes a robot inspect every
/// corner before it follows the building; the weighted mean alone makes it return for the corners (a
/// travelling salesman's and a travelling repairman's problem; for exploration, distance cost of Kulich,
/// Faigl and Preucil, ICRA 2011).
double tour_cost_m(const TourGoals& goals, const Tour& tour, double length_share);

/// A cheap tour of all goals, beginning with `first` when given: nearest neighbours, improved by reversing
/// pieces and moving pieces of up to three goals until neither helps. Intended for up to some dozens of
/// goals: a round of improvements costs the cube of their number. Deterministic; empty for no goals.
Tour cheap_tour(const TourGoals& goals, double length_share, std::optional<std::size_t> first = std::nullopt);

}  // namespace topo::exploration

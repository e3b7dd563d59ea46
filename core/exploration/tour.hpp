// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace topo::exploration {

/// Goals that one robot is to visit, each once: what the ways cost, and what the goals are worth.
struct TourGoals {
  explicit TourGoals(std::size_t goals)
      : count(goals), from_start_m(goals, 0.0), worth(goals, 0.0), between_m(goals * goals, 0.0) {}

  [[nodiscard]] double& between(std::size_t a, std::size_t b) { return between_m[a * count + b]; }
  [[nodiscard]] double between(std::size_t a, std::size_t b) const { return between_m[a * count + b]; }

  std::size_t count;
  std::vector<double> from_start_m;  ///< from where the robot is
  std::vector<double> worth;         ///< in any unit, not negative
  std::vector<double> between_m;     ///< symmetric, row by row
};

/// Every goal once, in the order in which they are visited.
using Tour = std::vector<std::size_t>;

/// What a tour costs, metres: `length_share` of its length, and for the rest the mean of what has been driven
/// when a goal is reached, weighed by the goals' worth. Length alone has a robot sweep up every corner before
/// it looks where the building goes on; worth alone has it come back for the corners (a travelling salesman's
/// and a travelling repairman's problem; for exploration, distance cost of Kulich, Faigl and Preucil, ICRA
/// 2011).
double tour_cost_m(const TourGoals& goals, const Tour& tour, double length_share);

/// A cheap tour of all goals, beginning with `first` when that is given: by nearest neighbours, improved by
/// turning pieces round and moving pieces of up to three goals until neither helps. Meant for up to some
/// dozens of goals: a round of improvements costs their number cubed. Deterministic; empty for no goals.
Tour cheap_tour(const TourGoals& goals, double length_share, std::optional<std::size_t> first = std::nullopt);

}  // namespace topo::exploration

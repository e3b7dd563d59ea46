// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tests/sim/raster.hpp"

namespace topo::bench::fresh {

/// What a floor is like, in measures that a drawn building and a recorded map have alike.
struct FloorFigures {
  double floor_m2 = 0.0;          ///< free, and within a step of where a robot gets
  std::vector<double> doors_m;    ///< widths of narrow passages, see passage_widths_m
  double pieces_per_100m2 = 0.0;  ///< solid pieces under 1 m across that stand free on the floor
  double furnished_share = 0.0;   ///< of the floor, under pieces of up to 3 m across
};

/// `start`: in free space.
FloorFigures floor_figures(const sim::Raster& free, const sim::Vector2& start);

/// Widths of the passages of up to 2.1 m that part wider places: two places whose largest discs are both
/// wider than the passage by kWider_m join there when discs are made smaller. A merge tree of the clearance;
/// the second of two doors between the same places is not counted. `poses`: where a robot gets.
inline constexpr double kWider_m = 0.5;
std::vector<double> passage_widths_m(const sim::Raster& free, const sim::Raster& poses);

/// The value below which a share of the values lies; 0 without values.
double quantile(std::vector<double> values, double share);

}  // namespace topo::bench::fresh

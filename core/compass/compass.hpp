// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/types/se2.hpp"

namespace topo::compass {

struct CompassParams {
  double cell_m = 0.05;              ///< the points are centres of cells of this size; 0: exact points
  double bin_m = 0.10;               ///< width of a bin of the projection
  double coarse_step_rad = 0.01745;  ///< 1 degree
  double fine_step_rad = 0.001745;   ///< 0.1 degree
  double confidence_min = 0.01;      ///< below: no dominant direction (cluttered floor plans have 0.02)
  std::size_t points_max = 20000;    ///< more are thinned evenly; at most UINT16_MAX
  std::size_t points_min = 30;       ///< those of 1.5 m of wall: fewer carry no information about a building
  std::size_t coarse_points = 6000;  ///< of the coarse curve: its minimum is a degree wide and needs no more
  std::size_t dips = 3;              ///< minima of the coarse curve that are evaluated with all points
  double aside_rad = 0.0873;  ///< 5 degrees: a minimum's depth is measured below the curve this far beside it
  /// Least depth of a minimum, in multiples of the curve's jitter. The lowest of 90 values of noise is 2.5
  /// sigma below their median.
  double jitters_min = 6.0;
  /// Result angles over a quarter turn, 0.05 degrees apart: a few more points then leave the angle, and all
  /// data in its frame, unchanged.
  long answers = 1800;
};

/// Dominant direction of a building (paper section II-A).
struct Compass {
  std::optional<double> angle_rad;  ///< in [0, pi/2), in steps of a quarter turn / CompassParams::answers;
                                    ///< nullopt: no dominant direction
  double confidence = 0.0;          ///< depth of the minimum below the curve's median, relative: 0 to 1
  std::vector<double> entropy;      ///< of both projections, summed, per coarse step from 0 to pi/2
};

/// Finds the sharpest minimum over orientation of the entropy of the histogram of the points' projections,
/// summed over two orthogonal projections; refined below fine_step_rad. The lowest value where none is sharp.
/// The order of the points does not matter. No direction for fewer than points_min points, or for a curve
/// whose minimum is no deeper than its jitter explains. Coordinates must be finite.
Compass entropy_compass(std::span<const types::Vector2> points, const CompassParams& params = {});

}  // namespace topo::compass

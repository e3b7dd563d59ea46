// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/compass/extent.hpp"
#include "core/compass/points_change.hpp"
#include "core/compass/projection.hpp"
#include "core/compass/sampling.hpp"
#include "core/types/se2.hpp"

namespace topo::compass {

struct CompassParams {
  double cell_m = 0.05;              ///< the points are centres of cells of this size; 0: exact points
  double bin_m = 0.10;               ///< width of a bin of the projection
  double coarse_step_rad = 0.01745;  ///< 1 degree
  double fine_step_rad = 0.001745;   ///< 0.1 degree
  double confidence_min = 0.01;      ///< below: no dominant direction (cluttered floor plans have 0.02)
  std::size_t points_max = 20000;    ///< more are thinned evenly; at most UINT16_MAX
};

/// Dominant direction of a building (paper section II-A).
struct Compass {
  std::optional<double> angle_rad;  ///< in [0, pi/2), in steps of 0.05 deg; nullopt: no dominant direction
  double confidence = 0.0;          ///< depth of the minimum below the curve's median, relative: 0 to 1
  std::vector<double> entropy;      ///< of both projections, summed, per coarse step from 0 to pi/2
};

/// Minimises the entropy of the histogram of the points' projections, summed over two orthogonal projections,
/// over orientation; refined below fine_step_rad. The order of the points does not matter. No direction for
/// fewer than 30 points, or for a curve whose minimum is no deeper than its jitter explains. Coordinates must
/// be finite.
Compass entropy_compass(std::span<const types::Vector2> points, const CompassParams& params = {});

/// Entropy curve at the angles evaluated last, with the underlying histograms.
struct KeptCurve {
  struct Kept {
    Kept(float radius, double angle_rad) : projection(radius, angle_rad) {}
    Projection projection;
    int unused = 0;  ///< number of compass updates since the last use
  };
  std::uint64_t limit = 0;    ///< greatest hash of its points
  std::map<double, Kept> at;  ///< by angle
};

/// State that one compass update passes to the next.
struct CompassMemory {
  Extent x_m, y_m;  ///< of the points
  Placing placing;
  float radius = 0.0F;
  Samples samples;  ///< the points
  KeptCurve few, all;
};

/// Incremental version with a bit-identical result: updates `memory` from the previous points to these by
/// adding and removing points in the histograms. `points`: the difference from the previous points; ignored
/// when there were none. The cost is that of the difference while both are within the same box.
Compass entropy_compass(const PointsChange& points, const CompassParams& params, CompassMemory& memory);

}  // namespace topo::compass

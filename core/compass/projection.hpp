// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace topo::compass {

/// Points relative to their centre, in half bins.
struct Cloud {
  std::vector<float> x;
  std::vector<float> y;
};

/// Number of points per half bin, and the sum of n log n over all bins, with n the points in one. Bins
/// overlap by half, so that the position of a wall relative to the bins does not matter.
class Histogram {
 public:
  explicit Histogram(std::size_t half_bins);

  /// One point for each of the half bins.
  void add(std::span<const std::int32_t> half_bins);
  [[nodiscard]] double sum() const;

 private:
  std::vector<std::uint16_t> points_;  ///< of the half bins, between an empty one and another
};

/// Histograms of the points' two projections at an angle, and their entropy.
class Projection {
 public:
  /// `radius`: the greatest distance of a point from the centre, in half bins. At most UINT16_MAX points.
  Projection(float radius, double angle_rad, const Cloud& cloud);

  [[nodiscard]] double entropy() const;

 private:
  std::size_t points_;
  Histogram along_, across_;
};

}  // namespace topo::compass

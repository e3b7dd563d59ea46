// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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

  /// `by`: 1 to add points, -1 to remove points that are present; one point for each of the half bins.
  void add(std::span<const std::int32_t> half_bins, int by);
  /// The same, with an incremental sum: for fewer than few() points it costs less than a new sum.
  void add_few(std::span<const std::int32_t> half_bins, int by);
  [[nodiscard]] std::size_t few() const { return points_.size() / 8; }

  double sum();

 private:
  std::vector<std::uint16_t> points_;  ///< of the half bins, between an empty one and another
  std::optional<double> sum_;          ///< nullopt: the points have changed since it was computed
};

/// Histograms of the points' two projections at an angle, and their entropy.
class Projection {
 public:
  /// `radius`: the greatest distance of a point from the centre, in half bins. At most UINT16_MAX points.
  Projection(float radius, double angle_rad);

  void add(const Cloud& cloud) { change(cloud, 1); }
  void remove(const Cloud& cloud) { change(cloud, -1); }

  [[nodiscard]] double entropy();

 private:
  void change(const Cloud& cloud, int by);

  float cos_, sin_, middle_;
  std::int64_t points_ = 0;
  Histogram along_, across_;
};

}  // namespace topo::compass

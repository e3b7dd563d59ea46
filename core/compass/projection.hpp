// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace topo::compass {

/// Points around their middle, in half bins.
struct Cloud {
  std::vector<float> x;
  std::vector<float> y;
};

/// Points by half bins, and the sum of n log n over all bins, n the points in one. Bins overlap by half:
/// where a wall lies between two then does not matter.
class Histogram {
 public:
  explicit Histogram(std::size_t half_bins);

  /// `by`: 1 for points that come, -1 for some that are there and go; one for each of the half bins.
  void add(std::span<const std::int32_t> half_bins, int by);
  /// The same, with the sum kept up to date: for fewer than few() it costs less than a sum made anew.
  void add_few(std::span<const std::int32_t> half_bins, int by);
  [[nodiscard]] std::size_t few() const { return points_.size() / 8; }

  double sum();

 private:
  std::vector<std::uint16_t> points_;  ///< of the half bins, after an empty one and before another
  std::optional<double> sum_;          ///< nothing: they have changed since it was made
};

/// Histograms of points' two projections at an angle, and their entropy.
class Projection {
 public:
  /// `radius`: no point is farther from the middle, in half bins. At most UINT16_MAX points.
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

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace topo::walls {

/// Points around their middle, in half bins.
struct Cloud {
  std::vector<float> x;
  std::vector<float> y;
};

/// Histograms of points' two projections at an angle, and their entropy. Bins overlap by half: where a wall
/// lies between two bins then does not matter.
class Projection {
 public:
  /// `radius`: no point is farther from the middle, in half bins. At most UINT16_MAX points.
  Projection(float radius, double angle_rad);

  void add(const Cloud& cloud) { change(cloud, 1); }
  void remove(const Cloud& cloud) { change(cloud, -1); }

  [[nodiscard]] double entropy() const;

 private:
  void change(const Cloud& cloud, int by);

  float cos_, sin_, middle_;
  std::int64_t points_ = 0;
  std::vector<std::uint16_t> along_, across_;
};

}  // namespace topo::walls

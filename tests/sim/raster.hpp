// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/sim/shapes.hpp"

namespace topo::sim {

/// Square cells over the building; row 0 has the lowest y, cell (0, 0) begins at `origin`.
struct Raster {
  double resolution_m = 0.05;
  Vector2 origin{0.0, 0.0};
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cells;

  Raster() = default;
  Raster(double resolution, const Vector2& lower_left, int w, int h, std::uint8_t value = 0)
      : resolution_m(resolution),
        origin(lower_left),
        width(w),
        height(h),
        cells(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), value) {}

  [[nodiscard]] bool inside(int ix, int iy) const { return ix >= 0 && iy >= 0 && ix < width && iy < height; }
  [[nodiscard]] std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(width) + static_cast<std::size_t>(ix);
  }
  [[nodiscard]] int column(double x_m) const {
    return static_cast<int>(std::floor((x_m - origin.x()) / resolution_m));
  }
  [[nodiscard]] int row(double y_m) const {
    return static_cast<int>(std::floor((y_m - origin.y()) / resolution_m));
  }
  [[nodiscard]] Vector2 center(int ix, int iy) const {
    return {origin.x() + (ix + 0.5) * resolution_m, origin.y() + (iy + 0.5) * resolution_m};
  }
  /// Value of a cell, 0 outside.
  [[nodiscard]] std::uint8_t at(int ix, int iy) const {
    return inside(ix, iy) ? cells[index(ix, iy)] : std::uint8_t{0};
  }
  [[nodiscard]] std::uint8_t at(const Vector2& p) const { return at(column(p.x()), row(p.y())); }
  void set(int ix, int iy, std::uint8_t value) {
    if (inside(ix, iy)) cells[index(ix, iy)] = value;
  }
  /// Area of the cells that are not 0.
  [[nodiscard]] double area_m2() const;
};

}  // namespace topo::sim

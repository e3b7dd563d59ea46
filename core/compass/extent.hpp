// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <span>

#include "core/types/geometry.hpp"

namespace topo::compass {

/// From the least to the greatest of the values of points; low > high for no points.
struct Extent {
  double low = HUGE_VAL, high = -HUGE_VAL;

  void add(double value) {
    low = value < low ? value : low;
    high = high < value ? value : high;
  }
};

template <class F>
Extent extent_of(std::span<const types::Vector2> points, F&& value) {
  Extent extent;
  for (const types::Vector2& p : points) extent.add(value(p));
  return extent;
}

/// The smallest rectangle around points; at least one.
inline types::Rectangle box_of(std::span<const types::Vector2> points) {
  const Extent x_m = extent_of(points, [](const types::Vector2&p) { return p.x(); }),
               y_m = extent_of(points, [](const types::Vector2&p) { return p.y(); });
  return {{x_m.low, y_m.low}, {x_m.high, y_m.high}};
}

}  // namespace topo::compass

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "core/compass/points_change.hpp"

namespace topo::compass {

/// From the least to the greatest of the values of points; low > high for no points.
struct Extent {
  double low = HUGE_VAL, high = -HUGE_VAL;

  void add(double value) {
    low = value < low ? value : low;
    high = high < value ? value : high;
  }
  friend bool operator==(const Extent&, const Extent&) = default;
};

template <class F>
Extent extent_of(std::span<const types::Vector2> points, F&& value) {
  Extent extent;
  for (const types::Vector2& p : points) extent.add(value(p));
  return extent;
}

/// Updates the extent of the previous points. Costs only the difference, unless a point at an end is removed.
template <class F>
Extent renewed(Extent extent, const PointsChange& points, F&& value) {
  const auto was_at_end = [&](const types::Vector2& p) {
    const double was = value(p);
    return was <= extent.low || was >= extent.high;
  };
  if (extent.low > extent.high || std::any_of(points.gone.begin(), points.gone.end(), was_at_end))
    return extent_of(points.now, value);
  for (const types::Vector2& p : points.come) extent.add(value(p));
  return extent;
}

}  // namespace topo::compass

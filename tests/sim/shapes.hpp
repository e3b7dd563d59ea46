// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/types/geometry.hpp"
#include "core/types/se2.hpp"

namespace topo::sim {

using types::Se2;
using types::Vector2;

/// Simple closed polygon; the last point is joined to the first.
using Polygon = std::vector<Vector2>;

/// A standing or hanging object of the building: an outline between two heights.
struct Prism {
  Polygon outline;
  double z_min_m = 0.0;
  double z_max_m = 2.5;
};

/// Box with a rectangular outline of the given size around `center`, rotated by its heading.
Prism make_box(const Se2& center, double length_m, double width_m, double z_min_m, double z_max_m);

/// Polygon with 32 sides and the area of the circle; deviates from it by at most 0.4 % of the radius.
Prism make_cylinder(const Vector2& center, double radius_m, double z_min_m, double z_max_m);

bool contains(const Polygon& polygon, const Vector2& p);
types::Rectangle bounds(const Polygon& polygon);
double area_m2(const Polygon& polygon);  ///< positive when counter-clockwise
Polygon transformed(const Polygon& polygon, const Se2& pose);

}  // namespace topo::sim

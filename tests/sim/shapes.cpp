// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/shapes.hpp"

#include <cmath>
#include <numbers>

namespace topo::sim {

Prism make_box(const Se2& center, double length_m, double width_m, double z_min_m, double z_max_m) {
  const double l = 0.5 * length_m;
  const double w = 0.5 * width_m;
  return {transformed({{-l, -w}, {l, -w}, {l, w}, {-l, w}}, center), z_min_m, z_max_m};
}

Prism make_cylinder(const Vector2& center, double radius_m, double z_min_m, double z_max_m) {
  constexpr int kSides = 32;
  const double step = 2.0 * std::numbers::pi / kSides;
  // A regular polygon with the area of the circle: area = n/2 R^2 sin(2 pi / n).
  const double corner_m = radius_m * std::sqrt(step / std::sin(step));
  Prism prism{{}, z_min_m, z_max_m};
  for (int i = 0; i < kSides; ++i) {
    prism.outline.emplace_back(center.x() + corner_m * std::cos(i * step),
                               center.y() + corner_m * std::sin(i * step));
  }
  return prism;
}

bool contains(const Polygon& polygon, const Vector2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

types::Rectangle bounds(const Polygon& polygon) {
  types::Rectangle box;
  for (const Vector2& p : polygon) box.extend(p);
  return box;
}

double area_m2(const Polygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    twice += polygon[j].x() * polygon[i].y() - polygon[i].x() * polygon[j].y();
  }
  return 0.5 * twice;
}

Polygon transformed(const Polygon& polygon, const Se2& pose) {
  Polygon out;
  out.reserve(polygon.size());
  for (const Vector2& p : polygon) out.push_back(pose * p);
  return out;
}

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/area_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace topo::types {
namespace {

using types::Se2;
using types::Vector2;

template <class Visit>
void for_each_edge(const Polygon& polygon, Visit visit) {
  for (std::size_t i = 0; i < polygon.size(); ++i) visit(polygon[i], polygon[(i + 1) % polygon.size()]);
}

template <class Visit>
void for_each_polygon(const AreaLimits& limits, Visit visit) {
  if (limits.keep_in) visit(*limits.keep_in);
  for (const Polygon& polygon : limits.keep_out) visit(polygon);
}

double distance_to_edge_m(const Vector2& a, const Vector2& b, const Vector2& p) {
  const Vector2 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (a + t * along - p).norm();
}

double distance_to_edges_m(const Polygon& polygon, const Vector2& p) {
  double nearest_m = HUGE_VAL;
  for_each_edge(polygon, [&](const Vector2& a, const Vector2& b) {
    nearest_m = std::min(nearest_m, distance_to_edge_m(a, b, p));
  });
  return nearest_m;
}

/// Even-odd rule. The result for a point on an edge is arbitrary; the callers handle such points.
bool is_inside(const Polygon& polygon, const Vector2& p) {
  bool inside = false;
  for_each_edge(polygon, [&](const Vector2& a, const Vector2& b) {
    if ((a.y() > p.y()) == (b.y() > p.y())) return;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  });
  return inside;
}

constexpr double kOnEdge_m = 1e-9;

/// Greatest depth of a point inside a forbidden region, in metres; 0 for an allowed point.
double depth_m(const AreaLimits& limits, const Vector2& p) {
  double depth = 0.0;
  if (limits.keep_in && !is_inside(*limits.keep_in, p))
    depth = std::max(depth, distance_to_edges_m(*limits.keep_in, p));
  for (const Polygon& polygon : limits.keep_out)
    if (is_inside(polygon, p)) depth = std::max(depth, distance_to_edges_m(polygon, p));
  return depth;
}

bool is_near_an_edge(const AreaLimits& limits, const Vector2& p, double within_m) {
  bool near = false;
  for_each_polygon(limits, [&](const Polygon& q) { near = near || distance_to_edges_m(q, p) <= within_m; });
  return near;
}

constexpr std::size_t kOutlinePoints = 24;  // at most 11 cm apart on a P3-AT with its margin

/// Points at which rays from the centre leave the outline.
std::array<Vector2, kOutlinePoints> outline(const Footprint& f) {
  std::array<Vector2, kOutlinePoints> points;
  for (std::size_t i = 0; i < kOutlinePoints; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * static_cast<double>(i) / kOutlinePoints;
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    const double to_end_m = c == 0.0 ? HUGE_VAL : (c > 0.0 ? f.front_m : f.rear_m) / std::abs(c);
    const double to_side_m = s == 0.0 ? HUGE_VAL : f.half_width_m / std::abs(s);
    const double r_m = std::min({to_end_m, to_side_m, f.swing_radius_m});
    points[i] = {r_m * c, r_m * s};
  }
  return points;
}

Se2 moved(const Se2& T_map_base, const types::Twist2& twist, double time_s) {
  const double turn = twist.omega_radps * time_s, way = twist.v_mps * time_s;
  const double half = 0.5 * turn;
  const double chord = std::abs(half) < 1e-6 ? way : way * std::sin(half) / half;
  return T_map_base * Se2{chord * std::cos(half), chord * std::sin(half), turn};
}

}  // namespace

std::string_view to_text(AreaKind kind) { return kind == AreaKind::kHereFirst ? "here_first" : "keep_out"; }

std::optional<AreaKind> area_kind_of(std::string_view text) {
  for (const AreaKind kind : {AreaKind::kKeepOut, AreaKind::kHereFirst})
    if (text == to_text(kind)) return kind;
  return {};
}

bool is_within(const Polygon& polygon, const Vector2& p_map, double beside_m) {
  return is_inside(polygon, p_map) || distance_to_edges_m(polygon, p_map) <= beside_m;
}

bool allows(const AreaLimits& limits, const Vector2& p_map) {
  return depth_m(limits, p_map) == 0.0 && !is_near_an_edge(limits, p_map, kOnEdge_m) &&
         (!limits.keep_in || is_inside(*limits.keep_in, p_map));
}

double intrusion_m(const AreaLimits& limits, const Se2& T_map_base, const Footprint& footprint) {
  const Vector2 centre = T_map_base.translation();
  double deepest_m = depth_m(limits, centre);
  if (!is_near_an_edge(limits, centre, reach_m(footprint) + kOnEdge_m)) return deepest_m;
  for (const Vector2& p : outline(footprint))
    deepest_m = std::max(deepest_m, depth_m(limits, T_map_base * p));
  return deepest_m;
}

double area_free_time_s(const AreaLimits& limits, const Se2& T_map_base, const types::Twist2& twist,
                        const Footprint& footprint, double until_s) {
  constexpr double kStep_m = 0.03;
  constexpr double kSlack_m = 1e-4;  // tolerance for rounding and for sliding along an edge
  const double rim_mps = std::abs(twist.v_mps) + std::abs(twist.omega_radps) * reach_m(footprint);
  if (!(rim_mps > 0.0) || limits.empty()) return HUGE_VAL;
  const double step_s = kStep_m / rim_mps;
  double before_m = intrusion_m(limits, T_map_base, footprint);
  for (double t = 0.0; t < until_s;) {
    const double next = std::min(t + step_s, until_s);
    const double now_m = intrusion_m(limits, moved(T_map_base, twist, next), footprint);
    if (now_m > before_m + (before_m > 0.0 ? kSlack_m : 0.0)) return t;
    before_m = now_m;
    t = next;
  }
  return HUGE_VAL;
}

}  // namespace topo::types

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/wings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/bench/topobench/fresh/draws.hpp"

namespace topo::bench::fresh {
namespace {

constexpr double kInLine = 0.45;  // of further wings; the others are skew
constexpr double kSkewMin_rad = 0.15, kSkewMax_rad = 0.9;
constexpr double kApart_m = 0.4;
constexpr double kLinkMin_m = 1.2, kLinkMax_m = 2.4;
constexpr double kSameLine_m = 1e-6;
constexpr int kTries = 40;

double angle_of(const sim::Vector2& v) { return std::atan2(v.y(), v.x()); }
sim::Vector2 turned(const sim::Vector2& v, double angle_rad) { return sim::Se2{0.0, 0.0, angle_rad} * v; }

void add_way_out(const Space& space, const Wing& wing, std::vector<WayOut>& out) {
  const Box f = floor_of(space, wing.wall_m);
  const Box &b = space.box, &all = wing.outline;
  const double cx = 0.5 * (f.x0 + f.x1), cy = 0.5 * (f.y0 + f.y1);
  if (std::abs(b.x0 - all.x0) < kSameLine_m) out.push_back({{b.x0, cy}, {-1.0, 0.0}, f.height()});
  if (std::abs(b.x1 - all.x1) < kSameLine_m) out.push_back({{b.x1, cy}, {1.0, 0.0}, f.height()});
  if (std::abs(b.y0 - all.y0) < kSameLine_m) out.push_back({{cx, b.y0}, {0.0, -1.0}, f.width()});
  if (std::abs(b.y1 - all.y1) < kSameLine_m) out.push_back({{cx, b.y1}, {0.0, 1.0}, f.width()});
}

/// A strip from a to b, longer by `more_m` at each end.
sim::Polygon strip(const sim::Vector2& a, const sim::Vector2& b, double width_m, double more0_m,
                   double more1_m) {
  const sim::Vector2 along = (b - a).normalized();
  const sim::Vector2 aside = 0.5 * width_m * sim::Vector2(-along.y(), along.x());
  const sim::Vector2 from = a - more0_m * along, to = b + more1_m * along;
  return {from - aside, to - aside, to + aside, from + aside};
}

bool separated_by(const sim::Polygon& a, const sim::Polygon& b) {
  for (std::size_t i = 0, j = a.size() - 1; i < a.size(); j = i++) {
    const sim::Vector2 edge = a[i] - a[j];
    const sim::Vector2 normal(edge.y(), -edge.x());
    const auto beyond = [&](const sim::Vector2& p) { return normal.dot(p - a[i]) >= 0.0; };
    if (std::all_of(b.begin(), b.end(), beyond)) return true;
  }
  return false;
}

sim::Polygon outline_of(const Wing& wing, double more_m) {
  return sim::transformed(corners(grown(wing.outline, more_m)), wing.T_building_wing);
}

bool has_room(const FloorPlan& plan, const Wing& wing) {
  const sim::Polygon outline = outline_of(wing, kApart_m);
  return std::none_of(plan.wings.begin(), plan.wings.end(),
                      [&](const Wing& other) { return convex_overlap(outline, outline_of(other, 0.0)); }) &&
         std::none_of(plan.links.begin(), plan.links.end(),
                      [&](const sim::Polygon& link) { return convex_overlap(outline, link); });
}

bool is_quarter_turn(double theta_rad) {
  const double quarters = theta_rad / (0.5 * std::numbers::pi);
  return std::abs(quarters - std::round(quarters)) < kSameLine_m;
}

/// In whole cells where the wing is not turned or by quarters.
sim::Se2 pose_of(const sim::Vector2& joint, double theta_rad, const sim::Vector2& entry, bool in_line) {
  sim::Vector2 p = joint - turned(entry, theta_rad);
  if (in_line) p = {snapped(p.x()), snapped(p.y())};
  return {p.x(), p.y(), theta_rad};
}

}  // namespace

bool convex_overlap(const sim::Polygon& a, const sim::Polygon& b) {
  return !separated_by(a, b) && !separated_by(b, a);
}

std::vector<WayOut> ways_out(const Wing& wing) {
  std::vector<WayOut> corridors, halls;
  for (const Space& space : wing.spaces) {
    if (space.use == Use::kCorridor) add_way_out(space, wing, corridors);
    if (space.use == Use::kHall) add_way_out(space, wing, halls);
  }
  return corridors.empty() ? halls : corridors;
}

bool attach(FloorPlan& plan, Wing wing, sim::Random& random) {
  const std::vector<WayOut> entries = ways_out(wing);
  for (int i = 0; i < kTries && !entries.empty(); ++i) {
    const Wing& host = plan.wings[one_of(random, plan.wings.size())];
    const std::vector<WayOut> exits = ways_out(host);
    if (exits.empty()) continue;
    const WayOut &exit = exits[one_of(random, exits.size())],
                 &entry = entries[one_of(random, entries.size())];
    const double side = happens(random, 0.5) ? 1.0 : -1.0;
    const bool in_line = happens(random, kInLine);
    const double skew_rad = in_line ? 0.0 : side * random.uniform(kSkewMin_rad, kSkewMax_rad);
    const double width_m = std::clamp(std::min(exit.width_m, entry.width_m), kLinkMin_m, kLinkMax_m);
    const sim::Vector2 from = host.T_building_wing * exit.at;
    const sim::Vector2 out = turned(exit.normal, host.T_building_wing.theta_rad);
    const sim::Vector2 on = turned(out, skew_rad);
    const sim::Vector2 joint = from + (in_line ? 0.5 : random.uniform(0.8, 3.0)) * out;
    const double length_m = random.uniform(0.6, 9.0);
    const double theta_rad = angle_of(on) + std::numbers::pi - angle_of(entry.normal);
    wing.T_building_wing = pose_of(joint + length_m * on, types::wrap_angle(theta_rad), entry.at,
                                   in_line && is_quarter_turn(host.T_building_wing.theta_rad));
    if (!has_room(plan, wing)) continue;
    const sim::Vector2 to = wing.T_building_wing * entry.at;
    const sim::Polygon first = strip(from, joint, width_m, host.wall_m + kCell_m, 0.3 * width_m);
    const sim::Polygon second = strip(joint, to, width_m, 0.3 * width_m, wing.wall_m + kCell_m);
    const bool crosses = std::any_of(plan.wings.begin(), plan.wings.end(), [&](const Wing& other) {
      return &other != &host && (convex_overlap(first, outline_of(other, kApart_m)) ||
                                 convex_overlap(second, outline_of(other, kApart_m)));
    });
    if (crosses) continue;
    plan.wings.push_back(std::move(wing));
    plan.links.push_back(first);
    plan.links.push_back(second);
    return true;
  }
  return false;
}

}  // namespace topo::bench::fresh

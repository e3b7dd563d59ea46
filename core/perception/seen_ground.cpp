// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/seen_ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/perception/footprint_sweep.hpp"
#include "core/types/beam_directions.hpp"

namespace topo::perception {
namespace {

using types::Se2;
using types::Vector2;

constexpr double kStep_m = 0.03;  // of the raster: less than a cell, so that none is skipped

std::int32_t cell(double at_m, double cell_m) { return static_cast<std::int32_t>(std::floor(at_m / cell_m)); }

/// True when holds(point) is true for all points of a raster over the outline, in base. Stops at the first
/// point for which it is false.
template <class Holds>
bool holds_all_over(const types::Footprint& outline, Holds holds) {
  for (double x = -outline.rear_m; x <= outline.front_m; x += kStep_m) {
    for (double y = -outline.half_width_m; y <= outline.half_width_m; y += kStep_m)
      if (contains(outline, {x, y}) && !holds(Vector2{x, y})) return false;
  }
  return true;
}

}  // namespace

std::size_t SeenGround::slot(std::int32_t x, std::int32_t y) {
  return static_cast<std::uint32_t>(y) % kSide * kSide + static_cast<std::uint32_t>(x) % kSide;
}

void SeenGround::see(const Vector2& p_odom, types::Stamp now) {
  const std::int32_t x = cell(p_odom.x(), kCell_m), y = cell(p_odom.y(), kCell_m);
  cells_[slot(x, y)] = {x, y, now};
}

bool SeenGround::is_seen(const Vector2& p_odom, types::Stamp since) const {
  const std::int32_t x = cell(p_odom.x(), kCell_m), y = cell(p_odom.y(), kCell_m);
  const Cell& c = cells_[slot(x, y)];
  return c.seen != types::Stamp{} && c.x == x && c.y == y && c.seen >= since;
}

void SeenGround::update(const types::Scan& scan, const Se2& T_base_laser, const Se2& T_odom_base,
                        const types::Footprint& outline, const SeenGroundParams& params) {
  // Only cells that lie completely within the outline: the rest of a cell at its edge has not been seen.
  const types::Footprint within = types::grown(outline, -std::numbers::sqrt2 * kCell_m);
  holds_all_over(within, [&](const Vector2& p) {
    see(T_odom_base * p, scan.arrival);
    return true;
  });
  const Se2 T_odom_laser = T_odom_base * T_base_laser;
  types::BeamDirections direction(scan.geometry, T_odom_laser.theta_rad);
  for (std::size_t i = 0; i < scan.beams; ++i, direction.advance()) {
    const float range_m = scan.range_m[i];
    if (i % params.beam_stride != 0 || !(types::is_hit(range_m) || range_m == types::kNoReturn)) continue;
    const double until_m = std::min(params.beam_m, static_cast<double>(range_m) - kCell_m);
    for (double at_m = 0.0; at_m <= until_m; at_m += kStep_m)
      see(T_odom_laser.translation() + at_m * direction.now(), scan.arrival);
  }
}

double SeenGround::behind_m(const Se2& T_odom_base, const types::Footprint& outline, types::Stamp since,
                            double far_m) const {
  double behind_m = 0.0;
  while (behind_m < far_m) {
    const double next_m = std::min(behind_m + kStep_m, far_m);
    const bool seen = holds_all_over(outline, [&](const Vector2& p) {
      const Vector2 there{p.x() - next_m, p.y()};
      return contains(outline, there) || is_seen(T_odom_base * there, since);
    });
    if (!seen) break;
    behind_m = next_m;
  }
  return behind_m;
}

}  // namespace topo::perception

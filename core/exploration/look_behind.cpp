// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/look_behind.hpp"

#include <cmath>
#include <numbers>

namespace topo::exploration {
namespace {

using types::Vector2;

/// True when a ray from the robot leads over free cells to an unknown one.
bool ends_unknown(const grid::DenseMap& map, const Vector2& from, const Vector2& direction, double reach_m) {
  for (double r_m = 0.0; r_m <= reach_m; r_m += map.resolution_m / 2.0) {
    const grid::CellState state = map.state(map.cell_at(from + r_m * direction));
    if (state == grid::CellState::kUnknown) return true;
    if (state == grid::CellState::kOccupied) return false;
  }
  return false;
}

}  // namespace

std::optional<double> heading_to_unseen(const grid::DenseMap& map, const types::Se2& T_map_base,
                                        const LookBehindParams& params) {
  const double dead_rad = std::numbers::pi - params.seen_rad;
  const int rays = static_cast<int>(std::floor(dead_rad / params.ray_rad));
  Vector2 sum(0.0, 0.0);
  int unknown = 0;
  for (int i = -rays; i <= rays; ++i) {
    const double angle_rad = T_map_base.theta_rad + std::numbers::pi + i * params.ray_rad;
    const Vector2 direction(std::cos(angle_rad), std::sin(angle_rad));
    if (!ends_unknown(map, T_map_base.translation(), direction, params.reach_m)) continue;
    sum += direction;
    ++unknown;
  }
  if (unknown < params.rays_min) return std::nullopt;
  return std::atan2(sum.y(), sum.x());
}

}  // namespace topo::exploration

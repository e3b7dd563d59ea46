// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/seen_through.hpp"

#include <algorithm>
#include <cmath>

namespace topo::travel {
namespace {

using types::Vector2;

/// True when the beam on either side of a direction hits something beyond a distance. A beam without a return
/// says nothing: black things give none.
bool sees_beyond(const types::Scan& scan, double angle_rad, double beyond_m) {
  const double at = (angle_rad - static_cast<double>(scan.geometry.angle_min_rad)) /
                    static_cast<double>(scan.geometry.angle_increment_rad);
  if (!(at >= 0.0) || at > static_cast<double>(scan.beams) - 1.0) return false;
  const auto hits_beyond = [&](double beam) {
    const float range_m = scan.range_m[static_cast<std::size_t>(beam)];
    return types::is_hit(range_m) && static_cast<double>(range_m) >= beyond_m;
  };
  return hits_beyond(std::floor(at)) && hits_beyond(std::ceil(at));
}

}  // namespace

std::vector<Vector2> seen_through(const types::Scan& scan, const types::Se2& T_map_laser,
                                  const DrivenWays& ways, const RouteMapParams& params) {
  std::vector<Vector2> points;
  const types::Se2 T_laser_map = T_map_laser.inverse();
  const auto is_near = [&](const Vector2& p) {
    return (p - T_map_laser.translation()).norm() <= params.live_range_m;
  };
  const auto look = [&](const Vector2& p_map) {
    const Vector2 p = T_laser_map * p_map;
    if (sees_beyond(scan, std::atan2(p.y(), p.x()), p.norm() + params.live_behind_m)) points.push_back(p_map);
  };
  for_each_point(ways.own, params.keyframe_gap_m, params.live_step_on_way_m, is_near, look);
  for (std::span<const types::KeyframePose> way : ways.mates)
    for_each_point(way, params.keyframe_gap_m, params.live_step_on_way_m, is_near, look);
  return points;
}

}  // namespace topo::travel

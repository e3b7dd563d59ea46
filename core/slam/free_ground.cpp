// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/free_ground.hpp"

#include <cmath>

namespace topo::slam {

FreeGround::FreeGround(const Point& origin, double width_m, const FreeGroundParams& params)
    : params_(params),
      origin_(origin),
      side_(static_cast<std::size_t>(std::ceil(width_m / static_cast<double>(params.cell_m)))),
      passed_(side_ * side_, 0) {}

std::size_t FreeGround::at(const Point& p) const {
  const Point cell = (p - origin_) / params_.cell_m;
  if (!(cell.x() >= 0.0F && cell.y() >= 0.0F)) return passed_.size();
  const auto x = static_cast<std::size_t>(cell.x()), y = static_cast<std::size_t>(cell.y());
  return x < side_ && y < side_ ? y * side_ + x : passed_.size();
}

void FreeGround::add_ray(const Point& from, const Point& to) {
  const Point way = to - from;
  const float length = way.norm();
  const int steps = static_cast<int>((length - params_.short_m) / params_.cell_m);
  for (int i = 0; i < steps; ++i) {
    const std::size_t cell = at(from + way * (static_cast<float>(i) * params_.cell_m / length));
    if (cell < passed_.size() && passed_[cell] < UINT8_MAX) ++passed_[cell];
  }
}

bool FreeGround::is_crossed(const Point& p_map) const {
  const std::size_t cell = at(p_map);
  return cell < passed_.size() && passed_[cell] >= params_.rays_min;
}

double FreeGround::contradiction(const SurfelMap& map, std::span<const Point> points,
                                 const types::Se2& T_map_base) const {
  if (points.empty()) return 0.0;
  std::size_t count = 0;
  for (const Point& point : points) {
    const Point p = (T_map_base * types::Vector2(point.cast<double>())).cast<float>();
    const std::size_t cell = at(p);
    if (cell == passed_.size() || passed_[cell] < params_.rays_min) continue;
    const Surfel* surfel = map.nearest(p);
    if (surfel == nullptr || (surfel->position - p).norm() > params_.near_m) ++count;
  }
  return static_cast<double>(count) / static_cast<double>(points.size());
}

FreeGround seen_through(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                        const SurfelMap& map, const FreeGroundParams& params) {
  FreeGround ground(map.origin(), map.width_m(), params);
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const Keyframe& keyframe = *keyframes[i];
    const auto in_map = [&](const Point& p) {
      return Point((poses[i] * types::Vector2(p.cast<double>())).cast<float>());
    };
    const Point from = in_map(keyframe.sensor);
    const std::vector<Point> points = keyframe.content.match_points();
    for (std::size_t k = 0; k < points.size(); k += params.ray_stride)
      ground.add_ray(from, in_map(points[k]));
  }
  return ground;
}

}  // namespace topo::slam

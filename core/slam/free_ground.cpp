// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/free_ground.hpp"

#include <cmath>

namespace topo::slam {
namespace {

constexpr float kCell_m = 0.15F;
constexpr float kShort_m = 0.40F;      ///< before its end a ray grazes the surface
constexpr float kNear_m = 0.20F;       ///< a surface within this distance explains a point
constexpr int kRays = 3;               ///< fewer rays may be noise
constexpr std::size_t kRayStride = 2;  ///< neighbouring rays cross the same ground

}  // namespace

FreeGround::FreeGround(const Point& origin, double width_m)
    : origin_(origin),
      side_(static_cast<std::size_t>(std::ceil(width_m / static_cast<double>(kCell_m)))),
      passed_(side_ * side_, 0) {}

std::size_t FreeGround::at(const Point& p) const {
  const Point cell = (p - origin_) / kCell_m;
  if (!(cell.x() >= 0.0F && cell.y() >= 0.0F)) return passed_.size();
  const auto x = static_cast<std::size_t>(cell.x()), y = static_cast<std::size_t>(cell.y());
  return x < side_ && y < side_ ? y * side_ + x : passed_.size();
}

void FreeGround::add_ray(const Point& from, const Point& to) {
  const Point way = to - from;
  const float length = way.norm();
  const int steps = static_cast<int>((length - kShort_m) / kCell_m);
  for (int i = 0; i < steps; ++i) {
    const std::size_t cell = at(from + way * (static_cast<float>(i) * kCell_m / length));
    if (cell < passed_.size() && passed_[cell] < UINT8_MAX) ++passed_[cell];
  }
}

double FreeGround::contradiction(const SurfelMap& map, std::span<const Point> points,
                                 const types::Se2& T_map_base) const {
  if (points.empty()) return 0.0;
  std::size_t count = 0;
  for (const Point& point : points) {
    const Point p = (T_map_base * types::Vector2(point.cast<double>())).cast<float>();
    const std::size_t cell = at(p);
    if (cell == passed_.size() || passed_[cell] < kRays) continue;
    const Surfel* surfel = map.nearest(p);
    if (surfel == nullptr || (surfel->position - p).norm() > kNear_m) ++count;
  }
  return static_cast<double>(count) / static_cast<double>(points.size());
}

FreeGround seen_through(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                        const SurfelMap& map) {
  FreeGround ground(map.origin(), map.width_m());
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const Keyframe& keyframe = *keyframes[i];
    const auto in_map = [&](const Point& p) {
      return Point((poses[i] * types::Vector2(p.cast<double>())).cast<float>());
    };
    const Point from = in_map(keyframe.sensor);
    for (std::size_t k = 0; k < keyframe.match_points.size(); k += kRayStride)
      ground.add_ray(from, in_map(keyframe.match_points[k]));
  }
  return ground;
}

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/surfel_map.hpp"

#include <algorithm>
#include <cmath>

namespace topo::slam {

SurfelMap::SurfelMap(double reach_m, double cell_m)
    : reach_(static_cast<float>(reach_m)),
      cell_(static_cast<float>(cell_m)),
      inverse_cell_(1.0F / static_cast<float>(cell_m)) {}

void SurfelMap::reset(const Point& centre, double half_width_m) {
  width_ = static_cast<std::uint32_t>(std::ceil(2.0 * half_width_m / static_cast<double>(cell_)));
  const float half = 0.5F * static_cast<float>(width_) * cell_;
  origin_ = centre - Point(half, half);
  cells_.assign(static_cast<std::size_t>(width_) * width_, Cell{});
  surfels_.clear();
}

void SurfelMap::add(std::span<const Surfel> surfels, const types::Se2& T_map_base) {
  const auto c = static_cast<float>(std::cos(T_map_base.theta_rad));
  const auto s = static_cast<float>(std::sin(T_map_base.theta_rad));
  const Point t = T_map_base.translation().cast<float>();
  const float extent = static_cast<float>(width_) * cell_;
  for (const Surfel& surfel : surfels) {
    const Point& p = surfel.position;
    const Point& n = surfel.normal;
    const Point moved(c * p.x() - s * p.y() + t.x(), s * p.x() + c * p.y() + t.y());
    const Point local = moved - origin_;
    if (!(local.x() >= 0.0F && local.y() >= 0.0F && local.x() < extent && local.y() < extent)) continue;
    surfels_.push_back({moved, Point(c * n.x() - s * n.y(), s * n.x() + c * n.y()), surfel.planar});
    claim(static_cast<std::int32_t>(surfels_.size() - 1));
  }
}

void SurfelMap::claim(std::int32_t index) {
  const Point local = surfels_[static_cast<std::size_t>(index)].position - origin_;
  const float reach2 = reach_ * reach_;
  const auto bound = [&](float v) {
    return static_cast<std::uint32_t>(std::clamp(v * inverse_cell_, 0.0F, static_cast<float>(width_ - 1)));
  };
  const std::uint32_t x0 = bound(local.x() - reach_), x1 = bound(local.x() + reach_);
  const std::uint32_t y0 = bound(local.y() - reach_), y1 = bound(local.y() + reach_);
  for (std::uint32_t y = y0; y <= y1; ++y) {
    const float dy = (static_cast<float>(y) + 0.5F) * cell_ - local.y();
    Cell* row = &cells_[static_cast<std::size_t>(y) * width_];
    for (std::uint32_t x = x0; x <= x1; ++x) {
      const float dx = (static_cast<float>(x) + 0.5F) * cell_ - local.x();
      const float d2 = dx * dx + dy * dy;
      if (d2 < reach2 && (row[x].surfel < 0 || d2 < row[x].distance2)) row[x] = {index, d2};
    }
  }
}

}  // namespace topo::slam

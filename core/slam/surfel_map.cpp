// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/surfel_map.hpp"

#include <algorithm>
#include <cmath>

namespace topo::slam {

SurfelMap::SurfelMap(double reach_m, double cell_m)
    : reach_(std::min(static_cast<float>(reach_m), static_cast<float>(kBlock * cell_m))),
      cell_(static_cast<float>(cell_m)),
      inverse_cell_(1.0F / static_cast<float>(cell_m)) {}

void SurfelMap::reset(const Point& centre, double half_width_m) {
  width_ = static_cast<std::uint32_t>(std::ceil(2.0 * half_width_m / static_cast<double>(cell_)));
  blocks_wide_ = (width_ + kBlock - 1) / kBlock;
  const float half = 0.5F * static_cast<float>(width_) * cell_;
  origin_ = centre - Point(half, half);
  index_.assign(static_cast<std::size_t>(blocks_wide_) * blocks_wide_, -1);
  blocks_.clear();
  surfels_.clear();
  next_.clear();
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
    put(static_cast<std::int32_t>(surfels_.size() - 1));
  }
}

void SurfelMap::put(std::int32_t index) {
  const Point local = surfels_[static_cast<std::size_t>(index)].position - origin_;
  const auto block_of = [&](float v) {
    return std::min(static_cast<std::uint32_t>(v * inverse_cell_), width_ - 1) / kBlock;
  };
  const std::uint32_t bx = block_of(local.x()), by = block_of(local.y());
  for (std::uint32_t y = by > 0 ? by - 1 : 0; y <= std::min(by + 1, blocks_wide_ - 1); ++y) {
    for (std::uint32_t x = bx > 0 ? bx - 1 : 0; x <= std::min(bx + 1, blocks_wide_ - 1); ++x) {
      std::int32_t& at = index_[static_cast<std::size_t>(y) * blocks_wide_ + x];
      if (at < 0) {
        at = static_cast<std::int32_t>(blocks_.size());
        blocks_.emplace_back();
      }
      blocks_[static_cast<std::size_t>(at)].known = 0;
    }
  }
  Block& own = blocks_[static_cast<std::size_t>(index_[static_cast<std::size_t>(by) * blocks_wide_ + bx])];
  next_.push_back(own.first);
  own.first = index;
}

void SurfelMap::find(Block& block, std::uint32_t cell, std::uint32_t ix, std::uint32_t iy) const {
  const Point centre((static_cast<float>(ix) + 0.5F) * cell_, (static_cast<float>(iy) + 0.5F) * cell_);
  const std::uint32_t bx = ix / kBlock, by = iy / kBlock;
  std::int32_t best = -1;
  float best2 = reach_ * reach_;
  for (std::uint32_t y = by > 0 ? by - 1 : 0; y <= std::min(by + 1, blocks_wide_ - 1); ++y) {
    for (std::uint32_t x = bx > 0 ? bx - 1 : 0; x <= std::min(bx + 1, blocks_wide_ - 1); ++x) {
      const std::int32_t at = index_[static_cast<std::size_t>(y) * blocks_wide_ + x];
      if (at < 0) continue;
      for (std::int32_t i = blocks_[static_cast<std::size_t>(at)].first; i >= 0;
           i = next_[static_cast<std::size_t>(i)]) {
        const float d2 = (surfels_[static_cast<std::size_t>(i)].position - origin_ - centre).squaredNorm();
        if (d2 < best2 || (d2 == best2 && best >= 0 && i < best)) {
          best = i;
          best2 = d2;
        }
      }
    }
  }
  block.nearest[cell] = best;
  block.known |= 1U << cell;
}

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/slam/cloud.hpp"

namespace topo::slam {

/// Surfels of several keyframes in one frame; the surfel nearest to a cell of 0.1 m is found in constant
/// time. It is computed at the first query of the cell and cached: a scan queries a small part of the cells
/// within reach of a map's surfels, and a map that serves one match (a loop candidate) would cost more to
/// precompute than to use. Sized for a window of the map, not the whole map. Queries write to the cache: one
/// thread at a time, even through const.
class SurfelMap {
 public:
  /// `reach_m`: maximum distance from the centre of a point's cell to the returned surfel; at most kBlock
  /// cells.
  explicit SurfelMap(double reach_m, double cell_m = 0.10);

  /// Empties the map and centres a window of the given half width on `centre`. Keeps the allocated memory.
  void reset(const Point& centre, double half_width_m);

  /// Adds a keyframe's surfels, given in its base_link, at its pose; drops those outside the window.
  void add(std::span<const Surfel> surfels, const types::Se2& T_map_base);

  /// The surfel nearest to the centre of p's cell (the first added of equally near ones); null beyond its
  /// reach or outside the window.
  [[nodiscard]] const Surfel* nearest(const Point& p) const {
    const float fx = (p.x() - origin_.x()) * inverse_cell_, fy = (p.y() - origin_.y()) * inverse_cell_;
    if (!(fx >= 0.0F && fy >= 0.0F)) return nullptr;
    const auto ix = static_cast<std::uint32_t>(fx), iy = static_cast<std::uint32_t>(fy);
    if (ix >= width_ || iy >= width_) return nullptr;
    const std::int32_t at = index_[(iy / kBlock) * blocks_wide_ + ix / kBlock];
    if (at < 0) return nullptr;
    Block& block = blocks_[static_cast<std::size_t>(at)];
    const std::uint32_t cell = (iy % kBlock) * kBlock + ix % kBlock;
    if ((block.known & (1U << cell)) == 0) find(block, cell, ix, iy);
    const std::int32_t index = block.nearest[cell];
    return index < 0 ? nullptr : &surfels_[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] std::span<const Surfel> surfels() const { return surfels_; }
  [[nodiscard]] const Point& origin() const { return origin_; }
  [[nodiscard]] double width_m() const { return width_ * static_cast<double>(cell_); }

 private:
  static constexpr std::uint32_t kBlock = 4;  ///< cells along a side of a block
  /// Blocks exist only around surfels: those that contain one and their eight neighbours.
  struct Block {
    std::int32_t first = -1;                                ///< newest surfel within; next_ continues
    std::uint32_t known = 0;                                ///< bit per cell: `nearest` is computed
    std::array<std::int32_t, kBlock* kBlock> nearest = {};  ///< surfel or -1
  };
  void put(std::int32_t index);
  void find(Block& block, std::uint32_t cell, std::uint32_t ix, std::uint32_t iy) const;

  float reach_, cell_, inverse_cell_;
  Point origin_ = Point::Zero();  ///< lower left corner
  std::uint32_t width_ = 0;       ///< cells
  std::uint32_t blocks_wide_ = 0;
  std::vector<std::int32_t> index_;    ///< block by position, or -1
  mutable std::vector<Block> blocks_;  ///< mutable: caches query results
  std::vector<Surfel> surfels_;
  std::vector<std::int32_t> next_;  ///< next surfel of the same block, or -1
};

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/slam/cloud.hpp"

namespace topo::slam {

/// Surfels of several keyframes in one frame, with the nearest one to a cell of 0.1 m found in constant time.
/// Which one that is, is worked out when the cell is first asked for and remembered: a scan asks for a small
/// part of the cells that a map has within reach of its surfels, and a map that serves one match (a loop
/// candidate) would cost more to prepare than to use. Sized for what it holds: a window of the map, not the
/// map. Lookups write to the memory of answers: one thread at a time, const or not.
class SurfelMap {
 public:
  /// `reach_m`: how far from a surfel a point still finds it; at most kBlock cells.
  explicit SurfelMap(double reach_m, double cell_m = 0.10);

  /// Empties the map and centres a window of the given half width on `centre`. Keeps its memory.
  void reset(const Point& centre, double half_width_m);

  /// Adds a keyframe's surfels, given in its base_link, at its pose. Those outside the window are left out.
  void add(std::span<const Surfel> surfels, const types::Se2& T_map_base);

  /// The surfel nearest to the centre of p's cell (of several as near the first that was added), or null
  /// beyond its reach or outside the window.
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
  /// Blocks exist around surfels alone: those that hold one and their eight neighbours.
  struct Block {
    std::int32_t first = -1;                                ///< newest surfel within; next_ leads on
    std::uint32_t known = 0;                                ///< bit per cell: `nearest` is worked out
    std::array<std::int32_t, kBlock* kBlock> nearest = {};  ///< surfel or -1
  };
  void put(std::int32_t index);
  void find(Block& block, std::uint32_t cell, std::uint32_t ix, std::uint32_t iy) const;

  float reach_, cell_, inverse_cell_;
  Point origin_ = Point::Zero();  ///< lower left corner
  std::uint32_t width_ = 0;       ///< cells
  std::uint32_t blocks_wide_ = 0;
  std::vector<std::int32_t> index_;    ///< block by place, or -1
  mutable std::vector<Block> blocks_;  ///< mutable: remembers answers
  std::vector<Surfel> surfels_;
  std::vector<std::int32_t> next_;  ///< of a surfel's block, or -1
};

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/box_counts.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace topo::places {

using grid::CellState;

BoxCounts::BoxCounts(const grid::DenseMap& map, const CompassFrame& frame)
    : box_(map.box), resolution_m_(map.resolution_m), frame_(frame), bin_m_(2.0 * map.resolution_m) {
  types::Rectangle extent;
  for (const int x : {0, map.width()}) {
    for (const int y : {0, map.height()}) {
      const types::Vector2 corner(map.box.min.x + x, map.box.min.y + y);
      extent.extend(frame.from_map(corner * map.resolution_m));
    }
  }
  if (map.cells.empty()) extent = {{0.0, 0.0}, {0.0, 0.0}};
  corner_ = extent.min;
  // One column and one row of zeros before the first bin.
  columns_ =
      (static_cast<std::size_t>((extent.max.x() - corner_.x()) / bin_m_) + 3 + kBlock - 1) / kBlock * kBlock;
  rows_ = static_cast<std::size_t>((extent.max.y() - corner_.y()) / bin_m_) + 3;
  along_columns_.resize(columns_ * rows_);
  before_blocks_.resize(columns_ / kBlock * rows_);
  for (int y = 0; y < map.height(); ++y) {
    const types::Vector2 start = row_start(y);
    const CellState* row =
        map.cells.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width());
    const CellState* const end = row + map.width();
    for (const CellState* at = row; at != end; ++at) {
      if (*at != CellState::kOccupied) {
        // Most cells are not occupied: the library tests many at once.
        at = static_cast<const CellState*>(
            std::memchr(at, static_cast<int>(CellState::kOccupied), static_cast<std::size_t>(end - at)));
        if (at == nullptr) break;
      }
      const Bin bin = bin_of(start, static_cast<double>(at - row));
      ++along_columns_[bin.row * columns_ + bin.column];
    }
  }
  sum_up();
}

/// Position of the row's first cell, in bins.
types::Vector2 BoxCounts::row_start(int y) const {
  const types::Vector2 centre = types::Vector2(box_.min.x + 0.5, box_.min.y + y + 0.5) * resolution_m_;
  return (frame_.from_map(centre) - corner_) / bin_m_;
}

BoxCounts::Bin BoxCounts::bin_of(const types::Vector2& row_start, double x) const {
  const double step = resolution_m_ / bin_m_;
  return {static_cast<std::size_t>(row_start.x() + x * step * frame_.cos) + 1,
          static_cast<std::size_t>(row_start.y() - x * step * frame_.sin) + 1};
}

void BoxCounts::sum_up() {
  std::uint32_t* before = before_blocks_.data() + columns_ / kBlock;
  for (std::size_t v = 1; v < rows_; ++v) {
    std::uint32_t* const here = &along_columns_[v * columns_];
    const std::uint32_t* const below = here - columns_;
    for (std::size_t u = 0; u < columns_; ++u) here[u] += below[u];
    std::uint32_t run = 0;
    for (std::size_t first = 0; first < columns_; first += kBlock) {
      *before++ = run;
      run = std::accumulate(here + first, here + first + kBlock, run);
    }
  }
}

/// Column and row inclusive.
std::uint32_t BoxCounts::occupied_up_to(std::size_t column, std::size_t row) const {
  const std::size_t block = column / kBlock;
  const std::uint32_t* const sums = &along_columns_[row * columns_];
  return std::accumulate(sums + block * kBlock, sums + column + 1,
                         before_blocks_[row * columns_ / kBlock + block]);
}

std::uint32_t BoxCounts::occupied_in(const types::Rectangle& box) const {
  const auto bin = [&](double at, double corner, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp(std::round((at - corner) / bin_m_), 0.0, static_cast<double>(count - 1)));
  };
  const std::size_t u0 = bin(box.min.x(), corner_.x(), columns_),
                    u1 = bin(box.max.x(), corner_.x(), columns_);
  const std::size_t v0 = bin(box.min.y(), corner_.y(), rows_), v1 = bin(box.max.y(), corner_.y(), rows_);
  return occupied_up_to(u1, v1) - occupied_up_to(u1, v0) - occupied_up_to(u0, v1) + occupied_up_to(u0, v0);
}

}  // namespace topo::places

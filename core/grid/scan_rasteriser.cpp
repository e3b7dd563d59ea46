// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/scan_rasteriser.hpp"

#include <cstdlib>

namespace topo::grid {

void ScanRasteriser::draw(OccupancyGrid& grid, const types::Se2& T_map_base, const Eigen::Vector2f& sensor,
                          std::span<const Eigen::Vector2f> hits, Sign sign) {
  if (hits.empty()) return;
  prepare(grid, T_map_base, sensor, hits);
  for (const CellIndex& end : ends_) trace(end);
  for (const CellIndex& end : ends_) marks_[at(end)] = kHit;
  apply(grid, sign);
}

void ScanRasteriser::prepare(const OccupancyGrid& grid, const types::Se2& T_map_base,
                             const Eigen::Vector2f& sensor, std::span<const Eigen::Vector2f> hits) {
  const double c = std::cos(T_map_base.theta_rad), s = std::sin(T_map_base.theta_rad);
  const auto cell = [&](const Eigen::Vector2f& p) {
    const double x = static_cast<double>(p.x()), y = static_cast<double>(p.y());
    return grid.cell_at({T_map_base.x_m + c * x - s * y, T_map_base.y_m + s * x + c * y});
  };
  from_ = cell(sensor);
  box_ = {};
  box_.extend(from_);
  ends_.clear();
  for (const Eigen::Vector2f& hit : hits) {
    ends_.push_back(cell(hit));
    box_.extend(ends_.back());
  }
  // Whole tiles, so that applying runs over them without tests.
  box_.min = {box_.min.x & ~(Tile::kSide - 1), box_.min.y & ~(Tile::kSide - 1)};
  box_.max = {box_.max.x | (Tile::kSide - 1), box_.max.y | (Tile::kSide - 1)};
  width_ = static_cast<std::size_t>(box_.width());
  marks_.assign(width_ * static_cast<std::size_t>(box_.height()), kNothing);
}

/// Bresenham's line without its last cell.
void ScanRasteriser::trace(CellIndex to) {
  const std::int32_t dx = std::abs(to.x - from_.x), dy = -std::abs(to.y - from_.y);
  const std::int32_t step_x = from_.x < to.x ? 1 : -1;
  const std::ptrdiff_t step_y =
      from_.y < to.y ? static_cast<std::ptrdiff_t>(width_) : -static_cast<std::ptrdiff_t>(width_);
  std::uint8_t* mark = &marks_[at(from_)];
  const std::uint8_t* const end = &marks_[at(to)];
  std::int32_t error = dx + dy;
  while (mark != end) {
    *mark = kMiss;
    const std::int32_t twice = 2 * error;
    if (twice >= dy) {
      error += dy;
      mark += step_x;
    }
    if (twice <= dx) {
      error += dx;
      mark += step_y;
    }
  }
}

void ScanRasteriser::apply(OccupancyGrid& grid, Sign sign) const {
  const auto delta = static_cast<std::uint16_t>(sign == Sign::kAdd ? 1 : 0xFFFF);  // -1 modulo 2^16
  for (std::int32_t y0 = box_.min.y; y0 < box_.max.y; y0 += Tile::kSide) {
    for (std::int32_t x0 = box_.min.x; x0 < box_.max.x; x0 += Tile::kSide) {
      Tile* tile = nullptr;
      for (int y = 0; y < Tile::kSide; ++y) {
        const std::uint8_t* marks = &marks_[at({x0, y0 + y})];
        for (int x = 0; x < Tile::kSide; ++x) {
          if (marks[x] == kNothing) continue;
          if (tile == nullptr) tile = &grid.tile_to_change(x0 / Tile::kSide, y0 / Tile::kSide);
          CellCounts& counts = tile->cells[Tile::index(x, y)];
          std::uint16_t& count = marks[x] == kHit ? counts.hits : counts.misses;
          count = static_cast<std::uint16_t>(count + delta);
        }
      }
    }
  }
}

}  // namespace topo::grid

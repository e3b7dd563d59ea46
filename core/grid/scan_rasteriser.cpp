// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/scan_rasteriser.hpp"

#include <array>
#include <cstdlib>
#include <cstring>

#include "core/grid/occupancy_grid.hpp"

namespace topo::grid {
namespace {

using Row = std::array<std::uint8_t, Tile::kSide>;
constexpr Row kBlank{};

/// Bresenham's line without its last cell. `stride`: offset from a cell to the one above it.
void trace(std::uint8_t* from, CellIndex begin, CellIndex end, std::ptrdiff_t stride, std::uint8_t mark) {
  const std::int32_t dx = std::abs(end.x - begin.x), dy = -std::abs(end.y - begin.y);
  const std::int32_t step_x = begin.x < end.x ? 1 : -1;
  const std::ptrdiff_t step_y = begin.y < end.y ? stride : -stride;
  const std::uint8_t* const to = from + (end.y - begin.y) * stride + (end.x - begin.x);
  std::int32_t error = dx + dy;
  while (from != to) {
    *from = mark;
    const std::int32_t twice = 2 * error;
    if (twice >= dy) {
      error += dy;
      from += step_x;
    }
    if (twice <= dx) {
      error += dx;
      from += step_y;
    }
  }
}

bool overlap(const CellBox& a, const CellBox& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y;
}

std::size_t place_in(const CellBox& box, CellIndex cell) {
  return static_cast<std::size_t>(cell.y - box.min.y) * static_cast<std::size_t>(box.width()) +
         static_cast<std::size_t>(cell.x - box.min.x);
}

}  // namespace

void ScanRasteriser::draw(OccupancyGrid& grid, const types::Se2& T_map_base, const Eigen::Vector2f& sensor,
                          std::span<const Eigen::Vector2f> hits) {
  if (hits.empty()) return;
  outline(after_, grid, T_map_base, sensor, hits);
  fill(after_, after_.box);
  apply(grid, after_.box, nullptr, &after_);
}

void ScanRasteriser::move(OccupancyGrid& grid, const types::Se2& before, const types::Se2& after,
                          const Eigen::Vector2f& sensor, std::span<const Eigen::Vector2f> hits) {
  if (hits.empty()) return;
  outline(before_, grid, before, sensor, hits);
  outline(after_, grid, after, sensor, hits);
  if (overlap(before_.box, after_.box)) {
    CellBox box = before_.box;
    box.extend(after_.box.min);
    box.extend(after_.box.max);
    fill(before_, box);
    fill(after_, box);
    apply(grid, box, &before_, &after_);
  } else {
    fill(before_, before_.box);
    apply(grid, before_.box, &before_, nullptr);
    fill(after_, after_.box);
    apply(grid, after_.box, nullptr, &after_);
  }
}

void ScanRasteriser::outline(Sketch& sketch, const OccupancyGrid& grid, const types::Se2& T_map_base,
                             const Eigen::Vector2f& sensor, std::span<const Eigen::Vector2f> hits) {
  const double c = std::cos(T_map_base.theta_rad), s = std::sin(T_map_base.theta_rad);
  const auto cell = [&](const Eigen::Vector2f& p) {
    const double x = static_cast<double>(p.x()), y = static_cast<double>(p.y());
    return grid.cell_at({T_map_base.x_m + c * x - s * y, T_map_base.y_m + s * x + c * y});
  };
  sketch.from = cell(sensor);
  CellBox& box = sketch.box = {};
  box.extend(sketch.from);
  sketch.ends.clear();
  for (const Eigen::Vector2f& hit : hits) {
    sketch.ends.push_back(cell(hit));
    box.extend(sketch.ends.back());
  }
  box.min = {box.min.x & ~(Tile::kSide - 1), box.min.y & ~(Tile::kSide - 1)};
  box.max = {box.max.x | (Tile::kSide - 1), box.max.y | (Tile::kSide - 1)};
}

void ScanRasteriser::fill(Sketch& sketch, const CellBox& box) {
  sketch.marks.assign(static_cast<std::size_t>(box.width() * box.height()), kNothing);
  std::uint8_t* const from = &sketch.marks[place_in(box, sketch.from)];
  for (const CellIndex& end : sketch.ends) trace(from, sketch.from, end, box.width(), kMiss);
  for (const CellIndex& end : sketch.ends) sketch.marks[place_in(box, end)] = kHit;
}

/// `before` is null when nothing was drawn before, `after` when nothing is drawn now.
void ScanRasteriser::apply(OccupancyGrid& grid, const CellBox& box, const Sketch* before,
                           const Sketch* after) {
  const auto row_of = [&](const Sketch* sketch, CellIndex cell) {
    return sketch == nullptr ? kBlank.data() : &sketch->marks[place_in(box, cell)];
  };
  for (std::int32_t y0 = box.min.y; y0 < box.max.y; y0 += Tile::kSide) {
    for (std::int32_t x0 = box.min.x; x0 < box.max.x; x0 += Tile::kSide) {
      Tile* tile = nullptr;
      for (int y = 0; y < Tile::kSide; ++y) {
        const std::uint8_t* const was = row_of(before, {x0, y0 + y});
        const std::uint8_t* const is = row_of(after, {x0, y0 + y});
        if (std::memcmp(was, is, Tile::kSide) == 0) continue;
        if (tile == nullptr) tile = &grid.tile_to_change(x0 / Tile::kSide, y0 / Tile::kSide);
        CellCounts* const counts = &tile->cells[Tile::index(0, y)];
        for (int x = 0; x < Tile::kSide; ++x) {
          counts[x].hits = static_cast<std::uint16_t>(counts[x].hits + (is[x] == kHit) - (was[x] == kHit));
          counts[x].misses =
              static_cast<std::uint16_t>(counts[x].misses + (is[x] == kMiss) - (was[x] == kMiss));
        }
      }
    }
  }
}

}  // namespace topo::grid

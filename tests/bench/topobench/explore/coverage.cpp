// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/coverage.hpp"

#include <algorithm>
#include <cmath>

#include "core/grid/occupancy_grid.hpp"

namespace topo::bench {
namespace {

std::int32_t floor_divide(std::int32_t a, std::int32_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

}  // namespace

Coverage::Coverage(const sim::Raster& visible, const types::Se2& T_building_map, double resolution_m)
    : covered_(visible.resolution_m, visible.origin, visible.width, visible.height) {
  constexpr int kSide = grid::Tile::kSide;
  const types::Se2 T_map_building = T_building_map.inverse();
  for (int y = 0; y < visible.height; ++y) {
    for (int x = 0; x < visible.width; ++x) {
      if (visible.at(x, y) == 0) continue;
      const types::Vector2 p = T_map_building * visible.center(x, y);
      const auto cx = static_cast<std::int32_t>(std::floor(p.x() / resolution_m));
      const auto cy = static_cast<std::int32_t>(std::floor(p.y() / resolution_m));
      const std::int32_t tx = floor_divide(cx, kSide), ty = floor_divide(cy, kSide);
      wanted_.push_back({patricia::cell_key(tx, ty),
                         static_cast<std::uint16_t>(grid::Tile::index(cx - tx * kSide, cy - ty * kSide)),
                         static_cast<std::uint32_t>(visible.index(x, y))});
    }
  }
  std::sort(wanted_.begin(), wanted_.end(), [](const Wanted& a, const Wanted& b) {
    return a.tile != b.tile ? a.tile < b.tile : a.cell < b.cell;
  });
  states_.assign(wanted_.size(), grid::CellState::kUnknown);
}

void Coverage::update(const grid::OccupancyGrid& grid) {
  static const grid::Tile kUnknown{};
  grid::OccupancyGrid::Tiles::difference(
      last_, grid.tiles(), [&](patricia::Key key, const grid::TileRef*, const grid::TileRef* now) {
        recount(key, now != nullptr ? now->read() : kUnknown);
      });
  last_ = grid.tiles();
}

void Coverage::recount(patricia::Key tile, const grid::Tile& content) {
  auto it = std::lower_bound(wanted_.begin(), wanted_.end(), tile,
                             [](const Wanted& w, patricia::Key key) { return w.tile < key; });
  for (; it != wanted_.end() && it->tile == tile; ++it) {
    const grid::CellState state = grid::state_of(content.cells[it->in_tile]);
    grid::CellState& before = states_[static_cast<std::size_t>(it - wanted_.begin())];
    if (state == before) continue;
    free_ += (state == grid::CellState::kFree ? 1U : 0U);
    free_ -= (before == grid::CellState::kFree ? 1U : 0U);
    known_ += (state != grid::CellState::kUnknown ? 1U : 0U);
    known_ -= (before != grid::CellState::kUnknown ? 1U : 0U);
    covered_.cells[it->cell] = state == grid::CellState::kFree ? 1 : 0;
    before = state;
  }
}

double Coverage::fraction(std::size_t cells) const {
  return wanted_.empty() ? 0.0 : static_cast<double>(cells) / static_cast<double>(wanted_.size());
}

}  // namespace topo::bench

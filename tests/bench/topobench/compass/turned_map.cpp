// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/compass/turned_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/se2.hpp"

namespace topo::bench {

grid::DenseMap turned_map(const grid::DenseMap& map, double turn_rad) {
  if (map.cells.empty()) return map;
  const types::Vector2 half(0.5 * map.width() * map.resolution_m, 0.5 * map.height() * map.resolution_m);
  const types::Vector2 middle =
      map.centre_of(map.box.min) - types::Vector2::Constant(0.5 * map.resolution_m) + half;
  const types::Se2 turn{0.0, 0.0, turn_rad};
  const double c = std::abs(std::cos(turn_rad)), s = std::abs(std::sin(turn_rad));
  const types::Vector2 reach(c * half.x() + s * half.y() + map.resolution_m,
                             s * half.x() + c * half.y() + map.resolution_m);
  grid::DenseMap out;
  out.resolution_m = map.resolution_m;
  out.box = {map.cell_at(middle - reach), map.cell_at(middle + reach)};
  out.cells.reserve(static_cast<std::size_t>(out.width()) * static_cast<std::size_t>(out.height()));
  const types::Se2 back = turn.inverse();
  for (std::int32_t y = out.box.min.y; y <= out.box.max.y; ++y) {
    for (std::int32_t x = out.box.min.x; x <= out.box.max.x; ++x)
      out.cells.push_back(map.state(map.cell_at(middle + back * (out.centre_of({x, y}) - middle))));
  }
  return out;
}

grid::DenseMap side_by_side(const grid::DenseMap& left, const grid::DenseMap& right) {
  constexpr std::int32_t kBetween = 20;
  grid::DenseMap both;
  both.resolution_m = left.resolution_m;
  both.box = {{0, 0},
              {left.width() + kBetween + right.width() - 1, std::max(left.height(), right.height()) - 1}};
  both.cells.assign(static_cast<std::size_t>(both.width()) * static_cast<std::size_t>(both.height()),
                    grid::CellState::kUnknown);
  const auto put = [&both](const grid::DenseMap& map, std::int32_t from_x) {
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const grid::CellIndex cell = map.cell(i);
      both.cells[both.index({from_x + cell.x - map.box.min.x, cell.y - map.box.min.y})] = map.cells[i];
    }
  };
  put(left, 0);
  put(right, left.width() + kBetween);
  return both;
}

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/compass/turned_map.hpp"

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

}  // namespace topo::bench

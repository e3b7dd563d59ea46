// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "tests/sim/area.hpp"

namespace topo::bench {
namespace {

constexpr double kSquare_m = 2.0;
constexpr double kNarrow_m = 1.5;  // from the way to the nearest wall

using Square = std::pair<int, int>;

Square square_of(const sim::Vector2& p) {
  return {static_cast<int>(std::floor(p.x() / kSquare_m)), static_cast<int>(std::floor(p.y() / kSquare_m))};
}

}  // namespace

Crossings count_crossings(const sim::Raster& free, std::span<const std::vector<sim::Se2>> ways) {
  const std::vector<float> clearance = sim::clearance_m(free);
  std::map<Square, std::size_t> passes;
  for (const std::vector<sim::Se2>& way : ways) {
    std::array<Square, 3> recent{Square{-1 << 20, 0}, Square{-1 << 20, 1}, Square{-1 << 20, 2}};
    for (const sim::Se2& pose : way) {
      const sim::Vector2 p = pose.translation();
      const int x = free.column(p.x()), y = free.row(p.y());
      if (!free.inside(x, y) || static_cast<double>(clearance[free.index(x, y)]) >= kNarrow_m) continue;
      const Square square = square_of(p);
      if (const auto at = std::find(recent.begin(), recent.end(), square); at != recent.end()) {
        std::rotate(recent.begin(), at, at + 1);
        continue;
      }
      ++passes[square];
      std::rotate(recent.begin(), recent.end() - 1, recent.end());
      recent.front() = square;
    }
  }
  const auto often =
      std::count_if(passes.begin(), passes.end(), [](const auto& entry) { return entry.second > 2; });
  return {passes.size(), static_cast<std::size_t>(often)};
}

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/sight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace topo::bench::bound {

Sight::Sight(const sim::World& world, const sim::Raster& visible, const SightParams& params)
    : world_(world), params_(params) {
  const double width_m = visible.width * visible.resolution_m,
               height_m = visible.height * visible.resolution_m;
  grid_ = sim::Raster(params.cell_m, visible.origin, static_cast<int>(std::ceil(width_m / params.cell_m)),
                      static_cast<int>(std::ceil(height_m / params.cell_m)));
  std::vector<int> count(grid_.cells.size(), 0);
  for (int y = 0; y < visible.height; ++y) {
    for (int x = 0; x < visible.width; ++x) {
      if (visible.at(x, y) == 0) continue;
      const sim::Vector2 p = visible.center(x, y);
      if (grid_.inside(grid_.column(p.x()), grid_.row(p.y())))
        ++count[grid_.index(grid_.column(p.x()), grid_.row(p.y()))];
    }
  }
  const double whole = params.cell_m * params.cell_m / (visible.resolution_m * visible.resolution_m);
  number_.assign(count.size(), -1);
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (2.0 * count[i] < whole) continue;
    number_[i] = static_cast<int>(centres_.size());
    const auto w = static_cast<std::size_t>(grid_.width);
    centres_.push_back(grid_.center(static_cast<int>(i % w), static_cast<int>(i / w)));
  }
}

int Sight::number_at(const sim::Vector2& p) const {
  const int x = grid_.column(p.x()), y = grid_.row(p.y());
  return grid_.inside(x, y) ? number_[grid_.index(x, y)] : -1;
}

CellSet Sight::from(const sim::Vector2& place) const {
  CellSet seen(centres_.size());
  sim::RayOptions options;
  options.range_max_m = params_.range_m;
  const double step_m = 0.5 * params_.cell_m;
  for (int i = 0; i < params_.beams; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / params_.beams;
    const sim::Vector2 direction(std::cos(angle), std::sin(angle));
    const double range_m = std::min(
        world_.cast({place.x(), place.y(), params_.z_m, direction.x(), direction.y(), 0.0}, options).range_m,
        params_.range_m);
    for (double s = 0.0; s < range_m; s += step_m) {
      if (const int n = number_at(place + s * direction); n >= 0) seen.insert(static_cast<std::size_t>(n));
    }
  }
  return seen;
}

std::vector<std::size_t> Sight::beside(std::size_t cell) const {
  std::vector<std::size_t> out;
  for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
    const int n = number_at(centres_[cell] + params_.cell_m * sim::Vector2(dx, dy));
    if (n >= 0) out.push_back(static_cast<std::size_t>(n));
  }
  return out;
}

}  // namespace topo::bench::bound

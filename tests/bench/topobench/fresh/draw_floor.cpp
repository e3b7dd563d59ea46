// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/draw_floor.hpp"

#include <algorithm>
#include <cmath>

#include "tests/bench/topobench/fresh/draws.hpp"

namespace topo::bench::fresh {
namespace {

constexpr double kMargin_m = 0.5;

types::Rectangle bounds_of(const FloorPlan& plan) {
  sim::Polygon all;
  for (const Wing& wing : plan.wings) {
    const sim::Polygon outline = sim::transformed(corners(wing.outline), wing.T_building_wing);
    all.insert(all.end(), outline.begin(), outline.end());
  }
  for (const sim::Polygon& link : plan.links) all.insert(all.end(), link.begin(), link.end());
  return sim::bounds(all);
}

/// Calls `use` with every cell whose centre lies in the outline.
template <class Use>
void for_cells(const sim::Polygon& outline, const sim::Raster& raster, Use&& use) {
  const types::Rectangle box = sim::bounds(outline);
  for (int y = std::max(0, raster.row(box.min.y()));
       y <= std::min(raster.height - 1, raster.row(box.max.y())); ++y) {
    for (int x = std::max(0, raster.column(box.min.x()));
         x <= std::min(raster.width - 1, raster.column(box.max.x())); ++x) {
      if (sim::contains(outline, raster.center(x, y))) use(x, y);
    }
  }
}

void fill(const sim::Polygon& outline, std::uint8_t value, sim::Raster& raster) {
  for_cells(outline, raster, [&](int x, int y) { raster.set(x, y, value); });
}

sim::Vector2 middle_of(const sim::Polygon& outline) {
  sim::Vector2 sum(0.0, 0.0);
  for (const sim::Vector2& p : outline) sum += p;
  return sum / static_cast<double>(outline.size());
}

}  // namespace

FloorPlan moved_to_origin(FloorPlan plan) {
  const types::Rectangle box = bounds_of(plan);
  // Whole cells, so that walls stay on their borders.
  const sim::Vector2 by(kMargin_m - std::floor(box.min.x() / kCell_m) * kCell_m,
                        kMargin_m - std::floor(box.min.y() / kCell_m) * kCell_m);
  for (Wing& wing : plan.wings) {
    wing.T_building_wing.x_m += by.x();
    wing.T_building_wing.y_m += by.y();
  }
  for (sim::Polygon& link : plan.links) {
    for (sim::Vector2& p : link) p += by;
  }
  return plan;
}

sim::Raster draw_floor(const FloorPlan& plan) {
  const types::Rectangle box = bounds_of(plan);
  const auto cells = [](double to_m) { return static_cast<int>(std::ceil((to_m + kMargin_m) / kCell_m)); };
  sim::Raster free(kCell_m, {0.0, 0.0}, cells(box.max.x()), cells(box.max.y()));
  for (const Wing& wing : plan.wings) {
    const auto placed = [&](const Box& b) { return sim::transformed(corners(b), wing.T_building_wing); };
    for (const Space& space : wing.spaces) {
      if (space.use != Use::kClosed) fill(placed(floor_of(space, wing.wall_m)), 1, free);
    }
    for (const Door& door : wing.doors) fill(placed(door.gap), 1, free);
  }
  for (const sim::Polygon& link : plan.links) fill(link, 1, free);
  for (const Wing& wing : plan.wings) {
    for (const Piece& piece : wing.pieces) {
      const sim::Polygon outline = sim::transformed(piece.outline, wing.T_building_wing);
      fill(outline, 0, free);
      const sim::Vector2 middle = middle_of(outline);  // of what is thinner than a cell
      free.set(free.column(middle.x()), free.row(middle.y()), 0);
    }
  }
  return free;
}

std::vector<SpaceCells> cells_of_spaces(const FloorPlan& plan, const sim::Raster& free) {
  std::vector<SpaceCells> out;
  for (std::size_t w = 0; w < plan.wings.size(); ++w) {
    const Wing& wing = plan.wings[w];
    for (std::size_t s = 0; s < wing.spaces.size(); ++s) {
      if (wing.spaces[s].use == Use::kClosed) continue;
      SpaceCells cells{w, s, {}};
      for_cells(sim::transformed(corners(floor_of(wing.spaces[s], wing.wall_m)), wing.T_building_wing), free,
                [&](int x, int y) {
                  if (free.at(x, y) != 0) cells.cells.push_back(free.index(x, y));
                });
      out.push_back(std::move(cells));
    }
  }
  return out;
}

}  // namespace topo::bench::fresh

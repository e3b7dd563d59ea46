// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/scan_rasteriser.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/grid/occupancy_grid.hpp"

#include <cmath>
#include <map>
#include <numeric>

namespace topo::grid {
namespace {

using Hits = std::vector<Eigen::Vector2f>;

struct Drawing {
  types::Se2 pose;
  Eigen::Vector2f sensor;
  Hits hits;
};

Drawing any_drawing() {
  const auto metres = [](int range) { return *rc::gen::inRange(-range, range) / 100.0; };
  Drawing drawing{{metres(500), metres(500), metres(314)},
                  {static_cast<float>(metres(20)), static_cast<float>(metres(20))},
                  {}};
  const int rays = *rc::gen::inRange(1, 12);
  for (int i = 0; i < rays; ++i) {
    drawing.hits.emplace_back(static_cast<float>(metres(800)), static_cast<float>(metres(800)));
  }
  return drawing;
}

std::map<std::pair<int, int>, std::pair<int, int>> contents(const OccupancyGrid& grid) {
  std::map<std::pair<int, int>, std::pair<int, int>> out;
  grid.for_each_known([&](CellIndex cell, CellState) {
    const CellCounts counts = grid.counts(cell);
    out[{cell.x, cell.y}] = {counts.hits, counts.misses};
  });
  return out;
}

TEST(ScanRasteriser, OneRayFreesItsWayAndHitsItsEnd) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.1);
  ScanRasteriser rasteriser;
  rasteriser.draw(grid, {0.05, 0.05, 0.0}, {0.0F, 0.0F}, Hits{{0.5F, 0.0F}});
  for (int x = 0; x < 5; ++x) EXPECT_EQ(grid.state({x, 0}), CellState::kFree) << x;
  EXPECT_EQ(grid.state({5, 0}), CellState::kOccupied);
  EXPECT_EQ(grid.state({6, 0}), CellState::kUnknown);
  EXPECT_EQ(contents(grid).size(), 6U);
}

TEST(ScanRasteriser, ACellCountsOnceAKeyframe) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.1);
  ScanRasteriser rasteriser;
  const Hits many(50, Eigen::Vector2f(1.0F, 0.0F));
  rasteriser.draw(grid, {0.05, 0.05, 0.0}, {0.0F, 0.0F}, many);
  EXPECT_EQ(grid.counts({10, 0}), (CellCounts{1, 0}));
  EXPECT_EQ(grid.counts({3, 0}), (CellCounts{0, 1}));
}

TEST(ScanRasteriser, AHitWinsOverARayThatPasses) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.1);
  ScanRasteriser rasteriser;
  rasteriser.draw(grid, {0.05, 0.05, 0.0}, {0.0F, 0.0F}, Hits{{0.3F, 0.0F}, {0.9F, 0.0F}});
  EXPECT_EQ(grid.counts({3, 0}), (CellCounts{1, 0}));
}

TEST(ScanRasteriser, OrderDoesNotMatterAndMovingIsExact) {
  EXPECT_TRUE(rc::check("the grid is a sum over drawings where they were moved to", [] {
    std::vector<Drawing> drawings;
    for (int i = *rc::gen::inRange(2, 6); i > 0; --i) drawings.push_back(any_drawing());
    const auto odd = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(drawings.size())));
    const types::Se2 elsewhere = any_drawing().pose;
    patricia::Arena<TileRef> arena;
    ScanRasteriser rasteriser;
    OccupancyGrid forward(arena, 0.05), backward(arena, 0.05);
    for (std::size_t i = 0; i < drawings.size(); ++i) {
      const Drawing& d = drawings[i];
      rasteriser.draw(forward, i == odd ? elsewhere : d.pose, d.sensor, d.hits);
    }
    for (std::size_t i = drawings.size(); i-- > 0;)
      rasteriser.draw(backward, drawings[i].pose, drawings[i].sensor, drawings[i].hits);
    const Drawing& d = drawings[odd];
    rasteriser.move(backward, d.pose, elsewhere, d.sensor, d.hits);
    RC_ASSERT(contents(forward) == contents(backward));
  }));
}

TEST(ScanRasteriser, MovesFarWithoutTouchingWhatLiesBetween) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.1);
  ScanRasteriser rasteriser;
  const Hits hits{{0.5F, 0.0F}};
  rasteriser.draw(grid, {0.05, 0.05, 0.0}, {0.0F, 0.0F}, hits);
  const double far_m = 1e5;  // a box of cells around both would not fit into memory
  rasteriser.move(grid, {0.05, 0.05, 0.0}, {far_m, far_m, 0.0}, {0.0F, 0.0F}, hits);
  EXPECT_EQ(grid.counts({3, 0}), CellCounts{});
  EXPECT_EQ(grid.state(grid.cell_at({far_m, far_m})), CellState::kFree);
  EXPECT_EQ(contents(grid).size(), 6U);
}

TEST(ScanRasteriser, LeavesTilesAloneThatSayTheSameAfterwards) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.1);
  ScanRasteriser rasteriser;
  const Hits hits{{0.5F, 0.0F}, {5.05F, 0.3F}};
  rasteriser.draw(grid, {0.05, 0.05, 0.0}, {0.0F, 0.0F}, hits);
  const OccupancyGrid snapshot = grid;
  rasteriser.move(grid, {0.05, 0.05, 0.0}, {0.051, 0.051, 0.0}, {0.0F, 0.0F}, hits);
  std::size_t copied = 0;
  OccupancyGrid::Tiles::difference(snapshot.tiles(), grid.tiles(),
                                   [&](patricia::Key, const TileRef*, const TileRef*) { ++copied; });
  EXPECT_EQ(copied, 0U);
}

TEST(ScanRasteriser, ARayIsAChainOfCellsBesideTheLine) {
  EXPECT_TRUE(rc::check([] {
    const auto coordinate = [] { return static_cast<float>(*rc::gen::inRange(-400, 400)) / 16.0F; };
    const Eigen::Vector2f from(coordinate(), coordinate()), to(coordinate(), coordinate());
    patricia::Arena<TileRef> arena;
    OccupancyGrid grid(arena, 0.125);
    ScanRasteriser rasteriser;
    rasteriser.draw(grid, {}, from, Hits{to});
    const CellIndex begin = grid.cell_at(from.cast<double>()), end = grid.cell_at(to.cast<double>());
    const int dx = end.x - begin.x, dy = end.y - begin.y, length = std::max(std::abs(dx), std::abs(dy));
    int cells = 0, hits = 0;
    grid.for_each_known([&](CellIndex c, CellState state) {
      ++cells;
      hits += state == CellState::kOccupied ? 1 : 0;
      // Off the line through the centres by half a cell at most, along the shorter side.
      RC_ASSERT(2 * std::abs((c.x - begin.x) * dy - (c.y - begin.y) * dx) <= length);
    });
    RC_ASSERT(cells == length + 1);
    RC_ASSERT(hits == 1);
    RC_ASSERT(grid.counts(end) == (CellCounts{1, 0}));
  }));
}

TEST(ScanRasteriser, WhatIsDrawnAWholeNumberOfCellsOnIsShifted) {
  EXPECT_TRUE(rc::check([] {
    Drawing d = any_drawing();
    for (Eigen::Vector2f& hit : d.hits) hit = (hit * 64.0F).array().round() / 64.0F;
    d.sensor = (d.sensor * 64.0F).array().round() / 64.0F;
    d.pose = {std::round(d.pose.x_m * 64.0) / 64.0, std::round(d.pose.y_m * 64.0) / 64.0, d.pose.theta_rad};
    const int x = *rc::gen::inRange(-100, 100), y = *rc::gen::inRange(-100, 100);
    patricia::Arena<TileRef> arena;
    OccupancyGrid here(arena, 0.125), there(arena, 0.125);
    ScanRasteriser rasteriser;
    rasteriser.draw(here, d.pose, d.sensor, d.hits);
    rasteriser.draw(there, {d.pose.x_m + 0.125 * x, d.pose.y_m + 0.125 * y, d.pose.theta_rad}, d.sensor,
                    d.hits);
    decltype(contents(here)) shifted;
    for (const auto& [cell, counts] : contents(here)) shifted[{cell.first + x, cell.second + y}] = counts;
    RC_ASSERT(contents(there) == shifted);
  }));
}

TEST(ScanRasteriser, WithoutHitsNothingIsDrawnOrMoved) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.1);
  ScanRasteriser rasteriser;
  rasteriser.draw(grid, {}, {0.0F, 0.0F}, {});
  rasteriser.move(grid, {}, {1.0, 0.0, 0.0}, {0.0F, 0.0F}, {});
  EXPECT_EQ(grid.tiles().size(), 0U);
}

}  // namespace
}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/scan_rasteriser.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <numeric>

namespace topo::grid {
namespace {

using Sign = ScanRasteriser::Sign;
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
  rasteriser.draw(grid, {0.05, 0.05, 0.0}, {0.0F, 0.0F}, Hits{{0.5F, 0.0F}}, Sign::kAdd);
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
  rasteriser.draw(grid, {0.05, 0.05, 0.0}, {0.0F, 0.0F}, many, Sign::kAdd);
  EXPECT_EQ(grid.counts({10, 0}), (CellCounts{1, 0}));
  EXPECT_EQ(grid.counts({3, 0}), (CellCounts{0, 1}));
}

TEST(ScanRasteriser, AHitWinsOverARayThatPasses) {
  patricia::Arena<TileRef> arena;
  OccupancyGrid grid(arena, 0.1);
  ScanRasteriser rasteriser;
  rasteriser.draw(grid, {0.05, 0.05, 0.0}, {0.0F, 0.0F}, Hits{{0.3F, 0.0F}, {0.9F, 0.0F}}, Sign::kAdd);
  EXPECT_EQ(grid.counts({3, 0}), (CellCounts{1, 0}));
}

TEST(ScanRasteriser, OrderDoesNotMatterAndRemovingIsExact) {
  EXPECT_TRUE(rc::check("the grid is a sum over drawings", [] {
    std::vector<Drawing> drawings;
    for (int i = *rc::gen::inRange(2, 6); i > 0; --i) drawings.push_back(any_drawing());
    const auto odd = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(drawings.size())));
    patricia::Arena<TileRef> arena;
    ScanRasteriser rasteriser;
    OccupancyGrid forward(arena, 0.05), backward(arena, 0.05);
    const auto draw = [&](OccupancyGrid& grid, const Drawing& d, Sign sign) {
      rasteriser.draw(grid, d.pose, d.sensor, d.hits, sign);
    };
    for (std::size_t i = 0; i < drawings.size(); ++i) {
      if (i != odd) draw(forward, drawings[i], Sign::kAdd);
    }
    for (std::size_t i = drawings.size(); i-- > 0;) draw(backward, drawings[i], Sign::kAdd);
    draw(backward, drawings[odd], Sign::kRemove);
    RC_ASSERT(contents(forward) == contents(backward));
  }));
}

}  // namespace
}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/spurs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "core/places/skeleton/skeleton_graph.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

/// An edge's end that sticks out no more than that.
bool is_spur(const grid::DenseMap& map, const SkeletonEdge& edge, const SkeletonNode& tip,
             const SkeletonNode& junction, double spur_m) {
  const double straight_m = (map.centre_of(tip.cell) - map.centre_of(junction.cell)).norm();
  const auto length_m = static_cast<double>(edge.length_m);
  const double away_m = length_m < 1.2 * straight_m + 2.0 * map.resolution_m ? straight_m : length_m;
  return away_m + static_cast<double>(tip.clearance_m - junction.clearance_m) <= spur_m;
}

/// As the graph of the whole axis says: ascending.
std::vector<std::uint32_t> spurs_of_graph(const grid::DenseMap& map, std::span<const float> clearance_m,
                                          double spur_m, Thinning thinning) {
  Skeleton skeleton;
  GraphTracer(map, clearance_m).trace(thinning, skeleton);
  std::vector<std::uint32_t> cells;
  const auto add = [&](std::span<const std::uint32_t> more) {
    cells.insert(cells.end(), more.begin(), more.end());
  };
  for (const SkeletonEdge& edge : skeleton.edges) {
    const SkeletonNode &a = skeleton.nodes[edge.a], &b = skeleton.nodes[edge.b];
    if ((a.degree == 1) == (b.degree == 1)) continue;
    const SkeletonNode &tip = a.degree == 1 ? a : b, &junction = a.degree == 1 ? b : a;
    if (!is_spur(map, edge, tip, junction, spur_m)) continue;
    add(skeleton.cells_of(edge));
    add(skeleton.cells_of(tip));
  }
  std::ranges::sort(cells);
  return cells;
}

TEST(Spurs, AreThoseOfTheGraphRoundByRound) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map = DrawnMap(60, 50).free(2, 2, 58, 48).map();
    draw_patches(map, 16, 9);
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    Thinning thinning = thin_to_ridge(map, erode(map, clearance_m));
    const double spur_m = 0.05 * *rc::gen::inRange(0, 16);
    SkeletonParams params;
    params.spur_m = spur_m;
    Spurs spurs(map, clearance_m, params);
    for (bool any = true; any;) {
      thin_to_lines(map, thinning);
      const std::vector<std::uint32_t> before = thinning.remain;
      const std::vector<std::uint32_t> expected = spurs_of_graph(map, clearance_m, spur_m, thinning);
      any = spurs.drop(thinning);
      std::vector<std::uint32_t> dropped;
      for (const std::uint32_t i : before) {
        if (thinning.marks[i] == 0) dropped.push_back(i);
        RC_ASSERT((thinning.marks[i] & (Thinning::kNode | Thinning::kEdge)) == 0);
      }
      std::ranges::sort(dropped);
      RC_ASSERT(dropped == expected);
      RC_ASSERT(any == !expected.empty());
    }
  }));
}

TEST(Spurs, OfACrossAreItsShortArms) {
  const grid::DenseMap map = DrawnMap(40, 9).free(2, 4, 38, 5).free(20, 2, 21, 7).map();
  const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  Thinning thinning = thin_to_ridge(map, erode(map, clearance_m));
  thin_to_lines(map, thinning);
  EXPECT_TRUE(Spurs(map, clearance_m, {}).drop(thinning));
  thin_to_lines(map, thinning);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const grid::CellIndex cell = map.cell(i);
    const bool is_way = cell.y == 4 && cell.x >= 2 && cell.x < 38;
    EXPECT_EQ(thinning.marks[i] != 0, is_way) << cell.x << ' ' << cell.y;
  }
}

TEST(Spurs, OfALineThereIsNone) {
  const grid::DenseMap map = DrawnMap(9, 5).free(2, 2, 6, 3).map();
  const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  Thinning thinning = thin_to_ridge(map, erode(map, clearance_m));
  thin_to_lines(map, thinning);
  EXPECT_FALSE(Spurs(map, clearance_m, {}).drop(thinning));
}

}  // namespace
}  // namespace topo::places

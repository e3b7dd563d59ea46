// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/skeleton.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

Skeleton skeleton_of(const DenseMap& map, const SkeletonParams& params = {}) {
  return skeletonise(map, grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown), params);
}

std::ptrdiff_t size_of(const Skeleton& skeleton) {
  return std::count(skeleton.on.begin(), skeleton.on.end(), std::uint8_t{1});
}

/// Pieces of furniture anywhere, so that rooms, loops, nooks and lone cells come about.
DenseMap random_map(int width, int height) {
  DrawnMap drawn(width, height);
  drawn.free(2, 2, width - 2, height - 2);
  const int count = *rc::gen::inRange(0, 40);
  for (int k = 0; k < count; ++k) {
    const int x = *rc::gen::inRange(0, width - 2), y = *rc::gen::inRange(0, height - 2);
    const int w = *rc::gen::inRange(1, 12), h = *rc::gen::inRange(1, 12);
    const auto state = *rc::gen::element(CellState::kOccupied, CellState::kUnknown, CellState::kFree);
    drawn.fill(x, y, std::min(x + w, width), std::min(y + h, height), state);
  }
  return drawn.map();
}

/// Components (over corners) and holes (over sides) of a set, the outside counted among the holes.
template <class F>
std::pair<int, int> topology(const DenseMap& map, F&& in) {
  return {count_components(map, true, in),
          count_components(map, false, [&](std::size_t i) { return !in(i); })};
}

void check_graph(const DenseMap& map, const Skeleton& s) {
  auto cells = s.axis;
  std::sort(cells.begin(), cells.end());
  RC_ASSERT(std::adjacent_find(cells.begin(), cells.end()) == cells.end());
  RC_ASSERT(static_cast<std::ptrdiff_t>(cells.size()) == size_of(s));
  for (const std::uint32_t i : cells) RC_ASSERT(s.on[i] == 1);
  std::vector<int> degree(s.nodes.size(), 0);
  for (const SkeletonEdge& e : s.edges) {
    ++degree[e.a];
    ++degree[e.b];
    RC_ASSERT(e.length_m > 0.0F);
    RC_ASSERT(e.clearance_min_m <= std::max(s.nodes[e.a].clearance_m, s.nodes[e.b].clearance_m));
  }
  for (std::size_t n = 0; n < degree.size(); ++n) {
    RC_ASSERT(degree[n] == s.nodes[n].degree);
    RC_ASSERT(s.on[map.index(s.nodes[n].cell)] == 1);
  }
  // What makes the graph's loops are the holes, of which the outside is none; a junction's own cells may
  // enclose one more.
  const auto [components, holes] = topology(map, [&](std::size_t i) { return s.on[i] != 0; });
  const int loops = static_cast<int>(s.edges.size()) - static_cast<int>(s.nodes.size()) + components;
  RC_ASSERT(loops <= holes - 1);
}

TEST(Skeleton, KeepsComponentsAndHoles) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = random_map(60, 50);
    const Skeleton s = skeleton_of(map);
    RC_ASSERT(topology(map, [&](std::size_t i) { return s.on[i] != 0; }) ==
              topology(map, [&](std::size_t i) { return map.cells[i] == CellState::kFree; }));
    for (std::size_t i = 0; i < s.on.size(); ++i) RC_ASSERT(s.on[i] == 0 || map.cells[i] == CellState::kFree);
    check_graph(map, s);
  }));
}

TEST(Skeleton, IsThin) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = random_map(28, 24);
    const Skeleton s = skeleton_of(map);
    const auto in = [&](std::size_t i) { return s.on[i] != 0; };
    const auto before = topology(map, in);
    const int width = map.width();
    for (const std::uint32_t i : s.axis) {
      int around = 0;
      for (const int by : {1, width + 1, width, width - 1, -1, -width - 1, -width, -width + 1})
        around += s.on[static_cast<std::size_t>(static_cast<int>(i) + by)];
      if (around < 2) continue;
      RC_ASSERT(topology(map, [&](std::size_t j) { return j != i && in(j); }) != before);
    }
  }));
}

TEST(Skeleton, OfNothingIsNothing) {
  EXPECT_TRUE(skeleton_of(DenseMap{}).on.empty());
  for (const CellState state : {CellState::kOccupied, CellState::kUnknown}) {
    const Skeleton s = skeleton_of(DrawnMap(20, 10).fill(0, 0, 20, 10, state).map());
    EXPECT_EQ(size_of(s), 0);
    EXPECT_TRUE(s.nodes.empty());
  }
}

TEST(Skeleton, OfOneCellIsThatCell) {
  const Skeleton s = skeleton_of(DrawnMap(9, 9).free(4, 5, 5, 6).map());
  EXPECT_EQ(size_of(s), 1);
  ASSERT_EQ(s.nodes.size(), 1U);
  EXPECT_EQ(s.nodes[0].cell, (grid::CellIndex{4, 5}));
  EXPECT_EQ(s.nodes[0].degree, 0);
  EXPECT_TRUE(s.edges.empty());
}

TEST(Skeleton, OfAPassageOneCellWideIsTheWholePassage) {
  const Skeleton s = skeleton_of(DrawnMap(50, 5).free(5, 2, 45, 3).map());
  EXPECT_EQ(size_of(s), 40);
  ASSERT_EQ(s.nodes.size(), 2U);
  ASSERT_EQ(s.edges.size(), 1U);
  EXPECT_NEAR(s.edges[0].length_m, 39 * 0.05, 1e-6);
  EXPECT_NEAR(s.edges[0].clearance_min_m, 0.05, 1e-6);
}

TEST(Skeleton, OfACorridorIsItsMiddleWithinACell) {
  const DrawnMap drawn = DrawnMap(400, 60).room(10, 10, 390, 49);
  const Skeleton s = skeleton_of(drawn.map());
  int in_middle = 0;
  for (const std::uint32_t i : s.axis) {
    const grid::CellIndex c = drawn.map().cell(i);
    if (c.x < 40 || c.x > 360) continue;
    EXPECT_NEAR(c.y, 29, 1);
    ++in_middle;
  }
  EXPECT_EQ(in_middle, 321);
}

TEST(Skeleton, OfARingHasANodeAndALoop) {
  const Skeleton s = skeleton_of(DrawnMap(20, 20).free(5, 5, 14, 14).occupied(6, 6, 13, 13).map());
  ASSERT_EQ(s.edges.size(), 1U);
  ASSERT_EQ(s.nodes.size(), 1U);
  EXPECT_EQ(s.nodes[0].degree, 2);
  EXPECT_EQ(s.edges[0].a, s.edges[0].b);
}

TEST(Skeleton, UnevenWallsMakeNoBranches) {
  DrawnMap drawn = DrawnMap(400, 60).room(10, 10, 390, 49);
  for (int x = 20; x < 380; x += 9) drawn.occupied(x, 10, x + 4, 12).free(x + 4, 49, x + 6, 52);
  const Skeleton s = skeleton_of(drawn.map());
  for (const SkeletonNode& node : s.nodes) EXPECT_TRUE(node.cell.x < 40 || node.cell.x > 360) << node.cell.x;
}

TEST(Skeleton, AnAlcoveIsABranchAndASpurWhenShallow) {
  const auto nodes_at = [](int depth) {
    const Skeleton s =
        skeleton_of(DrawnMap(200, 90).room(10, 10, 190, 50).free(90, 50, 110, 50 + depth).map());
    return std::count_if(s.nodes.begin(), s.nodes.end(),
                         [](const SkeletonNode& n) { return n.cell.x > 85 && n.cell.x < 115; });
  };
  EXPECT_EQ(nodes_at(5), 0);
  EXPECT_GE(nodes_at(30), 2);
}

}  // namespace
}  // namespace topo::places

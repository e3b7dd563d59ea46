// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/skeleton_graph.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

/// The graph of a map's axis, spurs and all.
struct Traced {
  explicit Traced(grid::DenseMap of)
      : map(std::move(of)),
        clearance_m(grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown)),
        thinning(thin_to_ridge(map, erode(map, clearance_m))) {
    thin_to_lines(map, thinning);
    GraphTracer tracer(map, clearance_m);
    tracer.trace(thinning, skeleton);
    tracer.find_narrowest(skeleton);
  }
  [[nodiscard]] bool touch(std::uint32_t i, std::uint32_t j) const {
    const grid::CellIndex a = map.cell(i), b = map.cell(j);
    return i != j && std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1;
  }

  grid::DenseMap map;
  std::vector<float> clearance_m;
  Thinning thinning;
  Skeleton skeleton;
};

Traced random_graph() {
  grid::DenseMap map = DrawnMap(50, 40).free(2, 2, 48, 38).map();
  draw_patches(map, *rc::gen::inRange(0, 24), 12);
  return Traced(std::move(map));
}

TEST(SkeletonGraph, AnEdgesCellsLeadFromNodeToNode) {
  EXPECT_TRUE(rc::check([] {
    const Traced traced = random_graph();
    const Skeleton& s = traced.skeleton;
    for (const SkeletonEdge& edge : s.edges) {
      const auto cells = s.cells_of(edge);
      const auto touches = [&](std::uint32_t i, const SkeletonNode& node) {
        return std::ranges::any_of(s.cells_of(node), [&](auto j) { return traced.touch(i, j); });
      };
      float least_m = HUGE_VALF;
      for (std::size_t k = 0; k < cells.size(); ++k) {
        least_m = std::min(least_m, traced.clearance_m[cells[k]]);
        if (k > 0) RC_ASSERT(traced.touch(cells[k - 1], cells[k]));  // RC_ASSERT evaluates both sides of ||
      }
      if (!cells.empty())
        RC_ASSERT(touches(cells.front(), s.nodes[edge.a]) && touches(cells.back(), s.nodes[edge.b]));
      RC_ASSERT(edge.clearance_min_m <= least_m);
      const float steps = static_cast<float>(cells.size() + 1);
      RC_ASSERT(edge.length_m >= 0.05F * steps - 1e-4F && edge.length_m <= 0.0708F * steps + 1e-4F);
    }
  }));
}

TEST(SkeletonGraph, EveryCellIsANodesOrAnEdgesOnce) {
  EXPECT_TRUE(rc::check([] {
    const Traced traced = random_graph();
    const Skeleton& s = traced.skeleton;
    std::vector<std::uint32_t> cells;
    const auto add = [&](const auto& part, std::uint8_t mark, std::uint8_t other) {
      for (const std::uint32_t i : s.cells_of(part)) {
        RC_ASSERT((traced.thinning.marks[i] & mark) != 0 && (traced.thinning.marks[i] & other) == 0);
        cells.push_back(i);
      }
    };
    for (const SkeletonNode& node : s.nodes) add(node, Thinning::kNode, Thinning::kEdge);
    for (const SkeletonEdge& edge : s.edges) add(edge, Thinning::kEdge, Thinning::kNode);
    std::vector<std::uint32_t> remain = traced.thinning.remain;
    std::ranges::sort(cells);
    std::ranges::sort(remain);
    RC_ASSERT(cells == remain);
  }));
}

TEST(SkeletonGraph, ANodeIsAtItsClearestCell) {
  EXPECT_TRUE(rc::check([] {
    const Traced traced = random_graph();
    for (const SkeletonNode& node : traced.skeleton.nodes) {
      const auto cells = traced.skeleton.cells_of(node);
      const auto at = static_cast<std::uint32_t>(traced.map.index(node.cell));
      RC_ASSERT(std::ranges::count(cells, at) == 1);
      for (const std::uint32_t i : cells) {
        RC_ASSERT(traced.clearance_m[i] <= node.clearance_m);
        RC_ASSERT(traced.clearance_m[i] < node.clearance_m || i >= at);
      }
    }
  }));
}

TEST(SkeletonGraph, OfACrossIsAJunctionWithFourArms) {
  const Traced traced(DrawnMap(31, 31).free(5, 15, 26, 16).free(15, 5, 16, 26).map());
  const Skeleton& s = traced.skeleton;
  ASSERT_EQ(s.nodes.size(), 5U);
  ASSERT_EQ(s.edges.size(), 4U);
  const auto is_junction = [](const SkeletonNode& n) { return n.degree == 4; };
  ASSERT_EQ(std::ranges::count_if(s.nodes, is_junction), 1);
  const SkeletonNode& junction = *std::ranges::find_if(s.nodes, is_junction);
  EXPECT_EQ(junction.cell, (grid::CellIndex{15, 15}));
  for (const SkeletonNode& node : s.nodes) EXPECT_TRUE(node.degree == 4 || node.degree == 1);
  for (const SkeletonEdge& edge : s.edges) {
    EXPECT_NE(s.nodes[edge.a].degree, s.nodes[edge.b].degree) << "from the junction to an end";
    // Ten cells from the middle to the end, of which the junction has two more.
    EXPECT_NEAR(edge.length_m, 0.05 * 9, 1e-5);
    EXPECT_NEAR(edge.clearance_min_m, 0.05, 1e-6);
  }
}

TEST(SkeletonGraph, AStraightAndASlantedLineHaveTheirLengths) {
  DrawnMap straight(30, 30), slanted(30, 30);
  for (int k = 5; k < 25; ++k) {
    straight.free(k, 10, k + 1, 11);
    slanted.free(k, k, k + 1, k + 1);
  }
  for (const auto& [drawn, length_m] :
       {std::pair(straight, 19 * 0.05), std::pair(slanted, 19 * 0.05 * std::sqrt(2.0))}) {
    const Traced traced(drawn.map());
    ASSERT_EQ(traced.skeleton.edges.size(), 1U);
    EXPECT_NEAR(traced.skeleton.edges[0].length_m, length_m, 1e-5);
    EXPECT_EQ(traced.skeleton.edges[0].cell_count, 18U);
  }
}

TEST(SkeletonGraph, OfTwoRingsIsANodeAndALoopEach) {
  const Traced traced(DrawnMap(40, 20)
                          .free(3, 3, 12, 12)
                          .occupied(4, 4, 11, 11)
                          .free(20, 5, 33, 15)
                          .occupied(21, 6, 32, 14)
                          .map());
  ASSERT_EQ(traced.skeleton.nodes.size(), 2U);
  ASSERT_EQ(traced.skeleton.edges.size(), 2U);
  for (const SkeletonEdge& edge : traced.skeleton.edges) {
    EXPECT_EQ(edge.a, edge.b);
    EXPECT_EQ(traced.skeleton.nodes[edge.a].degree, 2);
  }
}

}  // namespace
}  // namespace topo::places

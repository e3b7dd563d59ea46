// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/spanning_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// The tree's edges as Kruskal's algorithm has them: by rank and place in the list, whatever joins two parts.
std::vector<std::size_t> kruskal(std::size_t nodes, std::span<const Edge> edges, std::span<const int> ranks) {
  std::vector<std::size_t> order(edges.size()), part(nodes), tree;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::iota(part.begin(), part.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  for (const std::size_t i : order) {
    const std::size_t a = part[edges[i].from], b = part[edges[i].to];
    if (a == b) continue;
    std::replace(part.begin(), part.end(), a, b);
    tree.push_back(i);
  }
  return tree;
}

struct SpanningCase {
  explicit SpanningCase(unsigned seed) : random(seed), nodes(1 + random() % 20) {
    const std::vector<Se2> poses = testing::random_poses(nodes, random);
    edges = testing::measured_ties(poses, testing::random_ties(nodes, nodes, random), 0.5, random);
    for (std::size_t i = 0; i < edges.size(); ++i) ranks.push_back(static_cast<int>(random() % 3) - 1);
  }
  std::mt19937 random;
  std::size_t nodes;
  std::vector<Edge> edges;
  std::vector<int> ranks;
};

TEST(SpanningStart, ObeysTheEdgesOfTheLeastTree) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const SpanningCase graph(seed);
    const auto start = spanning_start(graph.nodes, graph.edges, graph.ranks);
    ASSERT_TRUE(start) << seed;
    ASSERT_EQ(start->size(), graph.nodes);
    EXPECT_EQ(start->front(), Se2{});
    const auto tree = kruskal(graph.nodes, graph.edges, graph.ranks);
    ASSERT_EQ(tree.size(), graph.nodes - 1);
    for (const std::size_t i : tree) {
      const Edge& edge = graph.edges[i];
      EXPECT_LT(edge_error(edge, (*start)[edge.from], (*start)[edge.to]).norm(), 1e-9) << seed << ": " << i;
    }
  }
}

TEST(SpanningStart, MovesWithTheFirstNode) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SpanningCase graph(seed);
    const Se2 first = testing::random_pose(graph.random);
    const auto here = spanning_start(graph.nodes, graph.edges, graph.ranks);
    const auto there = spanning_start(graph.nodes, graph.edges, graph.ranks, first);
    ASSERT_TRUE(here && there);
    EXPECT_LT(testing::greatest_difference(*there, testing::moved(first, *here)), 1e-9) << seed;
  }
}

TEST(SpanningStart, OfOneRobotSuccessiveNodesComeFirst) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SpanningCase graph(seed);
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
      const auto& [from, to] = std::minmax(graph.edges[i].from, graph.edges[i].to);
      graph.ranks[i] = to - from == 1 ? 4 : 7;  // which numbers the ranks are does not matter
    }
    EXPECT_EQ(spanning_start(graph.nodes, graph.edges), spanning_start(graph.nodes, graph.edges, graph.ranks))
        << seed;
  }
}

TEST(SpanningStart, WithoutATieThereIsNone) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SpanningCase graph(seed);
    EXPECT_FALSE(spanning_start(graph.nodes + 1, graph.edges, graph.ranks)) << seed;
  }
  EXPECT_EQ(spanning_start(0, {}), std::vector<Se2>{});
  EXPECT_EQ(spanning_start(1, {}, Se2{1.0, 2.0, 3.0}), (std::vector<Se2>{{1.0, 2.0, 3.0}}));
}

}  // namespace
}  // namespace topo::slam

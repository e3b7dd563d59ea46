// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_links.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

Edge edge(std::size_t from, std::size_t to, double length_m) {
  Edge out;
  out.from = from;
  out.to = to;
  out.T_from_to = {length_m, 0.0, 0.0};
  return out;
}

TEST(GraphLinks, TakesTheShorterWayEitherWayRound) {
  GraphLinks links{GraphParams{}.turn_on_spot_m};
  for (const Edge& e : {edge(0, 1, 3.0), edge(1, 2, 3.0), edge(2, 3, 3.0)}) links.add(e);
  EXPECT_NEAR(links.distances_m(4, 3)[0], 9.0, 0.2);
  links.add(edge(3, 0, 1.0));
  EXPECT_NEAR(links.distances_m(4, 3)[0], 1.0, 0.1);
  EXPECT_NEAR(links.distances_m(4, 0)[3], 1.0, 0.1);
  EXPECT_NEAR(links.distances_m(4, 0)[2], 4.0, 0.2);
}

TEST(GraphLinks, TurnsOnTheSpotMakeAWayLonger) {
  for (const double turn_m : {0.0, 0.05, 0.5}) {
    GraphLinks links{turn_m};
    for (const Edge& e : {edge(0, 1, 3.0), edge(1, 2, 0.0), edge(2, 3, 0.0)}) links.add(e);
    EXPECT_DOUBLE_EQ(links.distances_m(4, 0)[3], 3.0 + 3.0 * turn_m);
  }
}

TEST(GraphLinks, NoWayLeadsToWhatNothingTies) {
  GraphLinks links{GraphParams{}.turn_on_spot_m};
  links.add(edge(0, 1, 1.0));
  const auto distances_m = links.distances_m(4, 0);
  ASSERT_EQ(distances_m.size(), 4U);
  EXPECT_EQ(distances_m[3], HUGE_VAL);
  EXPECT_EQ(links.distances_m(4, 3)[0], HUGE_VAL);
  EXPECT_EQ(links.distances_m(4, 3)[3], 0.0);
}

/// Floyd and Warshall's algorithm on the lengths of links.
std::vector<std::vector<double>> all_distances_m(std::size_t nodes, std::span<const Edge> edges) {
  std::vector<std::vector<double>> d(nodes, std::vector<double>(nodes, HUGE_VAL));
  for (std::size_t i = 0; i < nodes; ++i) d[i][i] = 0.0;
  for (const Edge& e : edges) {
    const double length = std::hypot(e.T_from_to.x_m, e.T_from_to.y_m) + 0.05;  // no link is shorter
    d[e.from][e.to] = d[e.to][e.from] = std::min(d[e.from][e.to], length);
  }
  for (std::size_t k = 0; k < nodes; ++k) {
    for (std::size_t i = 0; i < nodes; ++i) {
      for (std::size_t j = 0; j < nodes; ++j) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
    }
  }
  return d;
}

TEST(GraphLinks, DistancesAreThoseOfTryingAllWays) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const std::size_t nodes = 2 + random() % 20;
    const auto poses = testing::random_poses(nodes, random);
    testing::NodePairs ties = testing::random_ties(nodes, random() % 20, random);
    ties.resize(ties.size() - random() % 3);  // maybe in pieces
    const std::vector<Edge> edges = testing::measured_ties(poses, ties, 0.1, random);
    GraphLinks links{GraphParams{}.turn_on_spot_m};
    for (const Edge& e : edges) links.add(e);
    const auto expected = all_distances_m(nodes, edges);
    for (std::size_t from = 0; from < nodes; ++from) {
      const auto found = links.distances_m(nodes, from);
      for (std::size_t to = 0; to < nodes; ++to) {
        if (expected[from][to] == HUGE_VAL) {
          EXPECT_EQ(found[to], HUGE_VAL) << seed;
        } else {
          EXPECT_NEAR(found[to], expected[from][to], 1e-9) << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace topo::slam

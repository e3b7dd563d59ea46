// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_pattern.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <random>
#include <tuple>

#include "core/slam/block_factor.hpp"
#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

std::vector<Edge> plain_edges(const testing::NodePairs& ties) {
  std::vector<Edge> edges(ties.size());
  for (std::size_t i = 0; i < ties.size(); ++i) std::tie(edges[i].from, edges[i].to) = ties[i];
  return edges;
}

/// By spreading from node 0 until nothing changes.
bool reaches_all(std::size_t nodes, const testing::NodePairs& ties) {
  std::vector<bool> reached(nodes, false);
  if (nodes > 0) reached[0] = true;
  for (std::size_t round = 0; round < nodes; ++round) {
    for (const auto& [a, b] : ties) reached[a] = reached[b] = reached[a] || reached[b];
  }
  return std::count(reached.begin(), reached.end(), true) == static_cast<std::ptrdiff_t>(nodes);
}

TEST(IsConnected, IsWhetherNode0ReachesAllOthers) {
  int connected = 0, apart = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const std::size_t nodes = 1 + random() % 12;
    testing::NodePairs ties = testing::random_ties(nodes, random() % 6, random);
    std::shuffle(ties.begin(), ties.end(), random);
    ties.resize(ties.size() - random() % (1 + ties.size() / 2));
    const bool expected = reaches_all(nodes, ties);
    EXPECT_EQ(is_connected(nodes, plain_edges(ties)), expected) << seed;
    ++(expected ? connected : apart);
  }
  EXPECT_GT(std::min(connected, apart), 50) << "both cases are tried";
}

TEST(IsConnected, NothingAndOneNodeAre) {
  EXPECT_TRUE(is_connected(0, {}));
  EXPECT_TRUE(is_connected(1, {}));
  EXPECT_FALSE(is_connected(2, {}));
}

TEST(IsConnected, EdgesThatSayNothingOfThePositionTieNothing) {
  std::vector<Edge> edges = plain_edges({{0, 1}});
  EXPECT_TRUE(is_connected(2, edges));
  edges[0].information = Eigen::Vector3d(0.0, 0.0, 1.0).asDiagonal();
  EXPECT_FALSE(is_connected(2, edges));
}

TEST(GraphPattern, VariablesAreTheNodesButTheFixedOne) {
  std::mt19937 random(3);
  const std::vector<Edge> edges = plain_edges(testing::random_ties(7, 4, random));
  for (std::size_t fixed = 0; fixed < 7; ++fixed) {
    const GraphPattern pattern(7, edges, fixed);
    std::vector<std::size_t> nodes, expected;
    for (std::size_t v = 0; v < pattern.elimination().variables(); ++v) nodes.push_back(pattern.node(v));
    for (std::size_t node = 0; node < 7; ++node)
      if (node != fixed) expected.push_back(node);
    EXPECT_EQ(nodes, expected);
    ASSERT_EQ(pattern.links().size(), edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const GraphPattern::EdgePlaces& places = pattern.links()[i];
      EXPECT_EQ(places.has_from, edges[i].from != fixed);
      EXPECT_EQ(places.has_to, edges[i].to != fixed);
      if (places.has_from) {
        EXPECT_EQ(pattern.node(places.from_variable), edges[i].from);
      }
      if (places.has_to) {
        EXPECT_EQ(pattern.node(places.to_variable), edges[i].to);
      }
    }
  }
}

TEST(GraphPattern, SeveralFixedNodesAreNoVariables) {
  std::mt19937 random(5);
  const std::vector<Edge> edges = plain_edges(testing::random_ties(9, 6, random));
  const std::size_t fixed[] = {0, 4, 8};
  const GraphPattern pattern(9, edges, fixed);
  std::vector<std::size_t> nodes;
  for (std::size_t v = 0; v < pattern.elimination().variables(); ++v) nodes.push_back(pattern.node(v));
  EXPECT_EQ(nodes, (std::vector<std::size_t>{1, 2, 3, 5, 6, 7}));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_EQ(pattern.links()[i].has_from, edges[i].from % 4 != 0);
    EXPECT_EQ(pattern.links()[i].has_to, edges[i].to % 4 != 0);
  }
}

TEST(IsConnected, FixedNodesTieTheirPieces) {
  std::vector<Edge> edges(2);
  edges[0].to = 1;
  edges[1].from = 2;
  edges[1].to = 3;
  const std::size_t both[] = {1, 3}, one[] = {3};
  EXPECT_FALSE(is_connected(4, edges));
  EXPECT_FALSE(is_connected(4, edges, one));
  EXPECT_TRUE(is_connected(4, edges, both));
}

/// Springs between nodes on a line, of which one is held: the blocks that the pattern names are those of the
/// graph's stiffness matrix without the row and column of the fixed node.
TEST(GraphPattern, PlacesAreThoseOfTheNormalEquations) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const std::size_t nodes = 2 + random() % 20, fixed = random() % nodes;
    const testing::NodePairs ties = testing::random_ties(nodes, random() % 15, random);
    const auto size = static_cast<Eigen::Index>(nodes);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
    const GraphPattern pattern(nodes, plain_edges(ties), fixed);
    BlockFactor<1> factor(pattern.elimination());
    for (std::size_t i = 0; i < ties.size(); ++i) {
      const BlockFactor<1>::Block spring(1.0 + static_cast<double>(random() % 9));
      const auto a = static_cast<Eigen::Index>(ties[i].first), b = static_cast<Eigen::Index>(ties[i].second);
      stiffness(a, a) += spring(0, 0);
      stiffness(b, b) += spring(0, 0);
      stiffness(a, b) -= spring(0, 0);
      stiffness(b, a) -= spring(0, 0);
      const GraphPattern::EdgePlaces& places = pattern.links()[i];
      if (places.has_from) factor.add(places.from, spring);
      if (places.has_to) factor.add(places.to, spring);
      if (places.has_from && places.has_to) factor.add(places.between, -spring);
    }
    std::vector<BlockFactor<1>::Vector> x(nodes - 1);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(size), moved = Eigen::VectorXd::Zero(size);
    for (std::size_t v = 0; v < x.size(); ++v) {
      x[v](0) = static_cast<double>(random() % 11) - 5.0;
      force(static_cast<Eigen::Index>(pattern.node(v))) = x[v](0);
    }
    ASSERT_TRUE(factor.factorise()) << seed;
    factor.solve(x);
    for (std::size_t v = 0; v < x.size(); ++v) moved(static_cast<Eigen::Index>(pattern.node(v))) = x[v](0);
    Eigen::VectorXd rest = stiffness * moved - force;
    rest(static_cast<Eigen::Index>(fixed)) = 0.0;  // whatever holds the node
    EXPECT_LT(rest.norm(), 1e-9 * (1.0 + moved.norm())) << seed;
  }
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/linear_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/slam/spanning_start.hpp"
#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// A random graph, and poses that say nothing about it but at the fixed node.
struct LinearCase {
  LinearCase(unsigned seed, double error, bool is_tree = false) : random(seed) {
    const std::size_t nodes = 2 + random() % 25;
    truth = testing::random_poses(nodes, random);
    edges = testing::measured_ties(truth, testing::random_ties(nodes, is_tree ? 0 : nodes, random), error,
                                   random);
    fixed = random() % nodes;
    start = testing::random_poses(nodes, random);
    start[fixed] = truth[fixed];
  }
  [[nodiscard]] std::vector<Se2> found() const { return found(start, edges); }
  [[nodiscard]] std::vector<Se2> found(std::vector<Se2> poses, std::span<const Edge> of) const {
    EXPECT_TRUE(start_linearly(poses, of, fixed));
    return poses;
  }

  std::mt19937 random;
  std::vector<Se2> truth, start;
  std::vector<Edge> edges;
  std::size_t fixed = 0;
};

/// What the edges say against the positions, the headings taken as they are.
double position_chi2(std::span<const Se2> poses, std::span<const Edge> edges) {
  double sum = 0.0;
  for (const Edge& edge : edges) {
    const Eigen::Vector2d error = edge_error(edge, poses[edge.from], poses[edge.to]).head<2>();
    sum += error.dot(edge.information.topLeftCorner<2, 2>() * error);
  }
  return sum;
}

TEST(StartLinearly, EdgesThatAgreeGiveTheTruth) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const LinearCase graph(seed, 0.0);
    const std::vector<Se2> found = graph.found();
    EXPECT_LT(testing::greatest_difference(found, graph.truth), 1e-8) << seed;
    EXPECT_EQ(found[graph.fixed], graph.truth[graph.fixed]) << seed;
  }
}

TEST(StartLinearly, OwesNothingToTheOtherPoses) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    LinearCase graph(seed, 0.05);
    std::vector<Se2> other = testing::random_poses(graph.start.size(), graph.random);
    other[graph.fixed] = graph.start[graph.fixed];
    EXPECT_EQ(graph.found(other, graph.edges), graph.found()) << seed;
  }
}

TEST(StartLinearly, MovesWithTheFixedNode) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    LinearCase graph(seed, 0.05);
    const Se2 by = testing::random_pose(graph.random);
    const std::vector<Se2> here = graph.found();
    EXPECT_LT(testing::greatest_difference(graph.found(testing::moved(by, graph.start), graph.edges),
                                           testing::moved(by, here)),
              1e-7)
        << seed;
  }
}

TEST(StartLinearly, TheOrderOfTheEdgesDoesNotMatter) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    LinearCase graph(seed, 0.05);
    std::vector<Edge> jumbled = graph.edges;
    std::shuffle(jumbled.begin(), jumbled.end(), graph.random);
    EXPECT_LT(testing::greatest_difference(graph.found(graph.start, jumbled), graph.found()), 1e-8) << seed;
  }
}

TEST(StartLinearly, OfATreeIsItsChains) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const LinearCase graph(seed, 0.3, true);
    const std::vector<Se2> found = graph.found();
    const auto chained = spanning_start(found.size(), graph.edges, found[0]);
    ASSERT_TRUE(chained);
    EXPECT_LT(testing::greatest_difference(found, *chained), 1e-7) << seed;
  }
}

TEST(StartLinearly, NoPositionCouldBeBetterAtTheseHeadings) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const LinearCase graph(seed, 0.05);
    std::vector<Se2> poses = graph.found();
    const double least = position_chi2(poses, graph.edges);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i == graph.fixed) continue;
      for (double Se2::*axis : {&Se2::x_m, &Se2::y_m}) {
        for (const double step : {-1e-3, 1e-3}) {
          poses[i].*axis += step;
          EXPECT_GT(position_chi2(poses, graph.edges), least) << seed << ": " << i;
          poses[i].*axis -= step;
        }
      }
    }
  }
}

TEST(StartLinearly, LeavesThePosesWhereNothingDetermines) {
  std::mt19937 random(8);
  std::vector<Se2> poses = testing::random_poses(3, random), before = poses;
  std::vector<Edge> edges{testing::measured(poses, 0, 1), testing::measured(poses, 1, 2, {0.1, 0.0, 0.0})};
  const Eigen::Matrix3d no_place = Eigen::Vector3d(0.0, 0.0, 1.0).asDiagonal();
  const Eigen::Matrix3d no_heading = Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal();
  for (const Eigen::Matrix3d& information : {no_place, no_heading}) {
    edges[1].information = information;
    EXPECT_FALSE(start_linearly(poses, edges)) << information;
    EXPECT_EQ(poses, before);
  }
  edges[1].information = Eigen::Matrix3d::Identity();
  EXPECT_TRUE(start_linearly(poses, edges));
  EXPECT_NE(poses, before);
}

TEST(StartLinearly, OfOneNodeOrNoneThereIsNothingToDo) {
  std::vector<Se2> none, one{{1.0, 2.0, 0.5}};
  EXPECT_TRUE(start_linearly(none, {}));
  EXPECT_TRUE(start_linearly(one, {}));
  EXPECT_EQ(one[0], (Se2{1.0, 2.0, 0.5}));
}

}  // namespace
}  // namespace topo::slam

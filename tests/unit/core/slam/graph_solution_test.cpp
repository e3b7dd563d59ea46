// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_solution.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

Edge edge(std::size_t from, std::size_t to) {
  Edge out;
  out.from = from;
  out.to = to;
  return out;
}

void expect_same_pose(const Se2& a, const Se2& b) {
  EXPECT_NEAR(a.x_m, b.x_m, 1e-12);
  EXPECT_NEAR(a.y_m, b.y_m, 1e-12);
  EXPECT_NEAR(a.theta_rad, b.theta_rad, 1e-12);
}

TEST(CorrectedPoses, WhatCameSinceKeepsItsPlaceBesideWhatItHangsOn) {
  const std::vector<Se2> poses{{}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {1.0, 3.0, 0.0}, {3.0, 0.0, 0.0}};
  const std::vector<Se2> solved{{}, {1.0, 0.1, 0.5}};
  // Node 2 goes on from 1, node 3 (a team-mate's) hangs on 0, node 4 goes on from 2 and was closed to 3.
  const std::vector<Edge> since{edge(1, 2), edge(3, 0), edge(2, 4), edge(3, 4)};
  const std::vector<Se2> all = corrected_poses(solved, poses, since);
  ASSERT_EQ(all.size(), poses.size());
  expect_same_pose(all[1], solved[1]);
  expect_same_pose(all[2], solved[1] * Se2{1.0, 0.0, 0.0});
  expect_same_pose(all[3], poses[3]);
  expect_same_pose(all[4], solved[1] * Se2{2.0, 0.0, 0.0});
}

TEST(SolveGraph, LeavesTheQuestionAsItIs) {
  GraphQuery query;
  query.poses = {{}, {1.0, 0.0, 0.0}};
  query.edges = {edge(0, 1)};
  query.edges[0].T_from_to = {1.2, 0.0, 0.0};
  const GraphSolution solution = solve_graph(query);
  EXPECT_TRUE(solution.report.solved);
  EXPECT_NEAR(solution.poses[1].x_m, 1.2, 1e-6);
  EXPECT_EQ(query.poses[1].x_m, 1.0);
}

TEST(CorrectedPoses, WhatIsMovedAsAWholeStaysAsItIs) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const std::size_t nodes = 3 + random() % 15, known = 1 + random() % (nodes - 1);
    const auto poses = testing::random_poses(nodes, random);
    const Se2 by = testing::random_pose(random);
    std::vector<Edge> since;
    for (std::size_t later = known; later < nodes; ++later)
      if (random() % 4 != 0) since.push_back(edge(later, random() % later));
    const auto first = std::span(poses).first(known);
    const std::vector<Se2> all = corrected_poses(testing::moved(by, first), poses, since);
    EXPECT_LT(testing::greatest_difference(all, testing::moved(by, poses)), 1e-9) << seed;
  }
}

TEST(CorrectedPoses, TheFirstEdgeSaysWhatANodeHangsOn) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const std::size_t nodes = 4 + random() % 15, known = 2 + random() % (nodes - 3);
    const auto poses = testing::random_poses(nodes, random), solved = testing::random_poses(known, random);
    std::vector<Edge> since;
    std::vector<std::size_t> anchors(nodes, nodes);
    for (std::size_t k = 0; k < 2 * nodes; ++k) {
      const std::size_t later = known + random() % (nodes - known), earlier = random() % later;
      since.push_back(k % 2 == 0 ? edge(earlier, later) : edge(later, earlier));
      if (anchors[later] == nodes) anchors[later] = earlier;
    }
    const std::vector<Se2> all = corrected_poses(solved, poses, since);
    ASSERT_EQ(all.size(), nodes);
    for (std::size_t i = known; i < nodes; ++i) {
      const std::size_t anchor = anchors[i] == nodes ? i - 1 : anchors[i];
      const Se2 between = all[anchor].inverse() * all[i];
      EXPECT_LT(testing::difference(between, poses[anchor].inverse() * poses[i]), 1e-9) << seed << ": " << i;
    }
  }
}

TEST(CorrectedPoses, WithoutAnEdgeANodeHangsOnTheOneBefore) {
  const std::vector<Se2> poses{{}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.5}, {2.0, 1.0, 0.0}};
  const Se2 turned{1.0, 0.0, 1.0};
  const std::vector<Se2> all = corrected_poses({{}, turned}, poses, {});
  for (const std::size_t i : {2U, 3U}) expect_same_pose(all[i], turned * (poses[1].inverse() * poses[i]));
  EXPECT_EQ(corrected_poses(poses, poses, {}), poses) << "nothing came since";
}

TEST(SolveGraph, DoesTheSameAsSolvingConsistently) {
  std::mt19937 random(4);
  GraphQuery query;
  const auto truth = testing::random_poses(12, random);
  query.edges = testing::measured_ties(truth, testing::random_ties(12, 10, random), 0.02, random);
  for (std::size_t i = 11; i < query.edges.size(); ++i) query.edges[i].robust = true;
  query.edges.back().T_from_to = query.edges.back().T_from_to * Se2{4.0, -3.0, 0.5};  // a false closure
  query.poses = truth;
  std::vector<Se2> expected = truth;
  const SolveReport report = solve_consistently(expected, query.edges, query.params);
  std::vector<Se2> with_all = truth;
  (void)solve(with_all, query.edges, query.params);
  ASSERT_NE(with_all, expected);
  const GraphSolution solution = solve_graph(query);
  EXPECT_EQ(solution.poses, expected);
  EXPECT_EQ(solution.report.chi2_end, report.chi2_end);
  query.edges.resize(5);  // in pieces
  EXPECT_FALSE(solve_graph(query).report.solved);
  EXPECT_EQ(solve_graph(query).poses, query.poses);
}

}  // namespace
}  // namespace topo::slam

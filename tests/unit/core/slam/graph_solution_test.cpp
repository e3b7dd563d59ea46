// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_solution.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/pose_graph.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <numbers>
#include <random>

namespace topo::slam {
namespace {

using types::Se2;

const GraphParams kParams;

std::vector<Se2> circle(std::size_t nodes, double radius_m) {
  std::vector<Se2> poses;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double a = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(nodes);
    poses.push_back(
        {radius_m * std::cos(a), radius_m * std::sin(a), types::wrap_angle(a + std::numbers::pi / 2)});
  }
  return poses;
}

Edge between(const std::vector<Se2>& poses, std::size_t from, std::size_t to, const Se2& error = {}) {
  Edge edge;
  edge.from = from;
  edge.to = to;
  edge.T_from_to = poses[from].inverse() * poses[to] * error;
  edge.information = Eigen::Vector3d(1e4, 1e4, 4e4).asDiagonal();
  return edge;
}

std::vector<Se2> chained(const Se2& first, std::span<const Edge> odometry) {
  std::vector<Se2> poses{first};
  for (const Edge& edge : odometry) poses.push_back(poses.back() * edge.T_from_to);
  return poses;
}

TEST(Solve, ClosesALoopThatDriftedApart) {
  const std::vector<Se2> truth = circle(60, 10.0);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i + 1 < truth.size(); ++i)
    edges.push_back(between(truth, i, i + 1, {0.01, -0.005, 0.004}));
  std::vector<Se2> poses = chained(truth[0], edges);
  const double apart = (poses.back().translation() - truth.back().translation()).norm();
  edges.push_back(between(truth, truth.size() - 1, 0));
  edges.back().robust = true;
  const SolveReport report = solve(poses, edges, {12, 1e6});
  EXPECT_TRUE(report.solved);
  EXPECT_GT(apart, 1.0);
  EXPECT_LT(report.chi2_end, 0.1 * report.chi2_start);
  EXPECT_LT((poses.back().translation() - truth.back().translation()).norm(), 0.1);
  EXPECT_EQ(poses[0], truth[0]) << "node 0 is fixed";
}

TEST(Solve, TheOptimumDoesNotDependOnTheOrderOfTheEdges) {
  EXPECT_TRUE(rc::check("any order", [] {
    const std::vector<Se2> truth = circle(20, 4.0);
    std::mt19937 random(static_cast<unsigned>(*rc::gen::inRange(0, 1000)));
    std::normal_distribution<double> noise(0.0, 0.01);
    std::vector<Edge> edges;
    for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
      edges.push_back(between(truth, i, i + 1, {noise(random), noise(random), noise(random)}));
    }
    std::vector<Se2> a = chained(truth[0], edges);
    edges.push_back(between(truth, 19, 0));
    edges.push_back(between(truth, 12, 2));
    std::vector<Se2> b = a;
    (void)solve(a, edges, kParams);
    std::shuffle(edges.begin(), edges.end(), random);
    (void)solve(b, edges, kParams);
    for (std::size_t i = 0; i < a.size(); ++i)
      RC_ASSERT((a[i].translation() - b[i].translation()).norm() < 1e-6);
  }));
}

TEST(Solve, OneFalseClosureAmongTrueOnesDoesNotTearTheMap) {
  const std::vector<Se2> truth = circle(60, 10.0);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i + 1 < truth.size(); ++i)
    edges.push_back(between(truth, i, i + 1, {0.002, 0.0, 0.0005}));
  std::vector<Se2> poses = chained(truth[0], edges);
  for (const std::size_t i : {57U, 58U, 59U}) {
    edges.push_back(between(truth, i, i - 57));
    edges.back().robust = true;
  }
  edges.push_back(between(truth, 30, 10, {3.0, -2.0, 0.4}));
  edges.back().robust = true;
  (void)solve(poses, edges, kParams);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT((poses[i].translation() - truth[i].translation()).norm(), 0.25) << i;
  }
}

TEST(Solve, ADisconnectedNodeIsSaidNotInvented) {
  std::vector<Se2> poses = circle(4, 1.0);
  const std::vector<Se2> before = poses;
  const std::vector<Edge> edges{between(poses, 0, 1)};
  const SolveReport report = solve(poses, edges, kParams);
  EXPECT_FALSE(report.solved);
  EXPECT_EQ(poses, before);
}

TEST(EdgeError, IsZeroAtTheMeasurement) {
  const std::vector<Se2> poses = circle(7, 3.0);
  EXPECT_LT(edge_error(between(poses, 2, 5), poses[2], poses[5]).norm(), 1e-12);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/pose_graph.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "core/slam/linear_start.hpp"
#include "core/slam/spanning_start.hpp"
#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

const GraphParams kGraphParams;

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

GraphParams exact() {
  GraphParams params;
  params.iterations_max = 200;
  params.converged = 1e-11;
  return params;
}

/// A circle driven three times with noisy dead reckoning, tied together at every fifth node.
struct Rounds {
  std::vector<Se2> truth, odometry;
  std::vector<Edge> edges;
};

Rounds three_rounds(unsigned seed, double noise_m, double noise_rad) {
  std::mt19937 random(seed);
  std::normal_distribution<double> m(0.0, noise_m), rad(0.0, noise_rad);
  const std::vector<Se2> once = circle(40, 8.0);
  Rounds rounds;
  for (int round = 0; round < 3; ++round) rounds.truth.insert(rounds.truth.end(), once.begin(), once.end());
  const auto add = [&](std::size_t from, std::size_t to) {
    const double x = m(random), y = m(random), theta = rad(random);
    rounds.edges.push_back(between(rounds.truth, from, to, {x, y, theta}));
  };
  for (std::size_t i = 0; i + 1 < rounds.truth.size(); ++i) add(i, i + 1);
  rounds.odometry = chained(rounds.truth[0], rounds.edges);
  for (std::size_t i = 40; i < rounds.truth.size(); i += 5) add(i, i - 40);
  return rounds;
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
  const SolveReport report = solve(poses, edges, {.loop_kernel = 1e6});
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
    (void)solve(a, edges, exact());
    std::shuffle(edges.begin(), edges.end(), random);
    (void)solve(b, edges, exact());
    for (std::size_t i = 0; i < a.size(); ++i)
      RC_ASSERT((a[i].translation() - b[i].translation()).norm() < 1e-9);
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
  (void)solve(poses, edges, kGraphParams);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_LT((poses[i].translation() - truth[i].translation()).norm(), 0.25) << i;
  }
}

/// Where the frame lies and which node holds it must not matter to what the edges say.
TEST(Solve, MovingOrAnchoringTheMapElsewhereChangesNoShape) {
  const Rounds rounds = three_rounds(3, 0.02, 0.01);
  std::vector<Se2> here = rounds.odometry, there = rounds.odometry, held = rounds.odometry;
  const Se2 shift{120.0, -45.0, 2.1};
  for (Se2& pose : there) pose = shift * pose;
  const SolveReport a = solve(here, rounds.edges, exact());
  const SolveReport b = solve(there, rounds.edges, exact());
  const SolveReport c = solve(held, rounds.edges, exact(), 57);
  ASSERT_TRUE(a.solved && b.solved && c.solved);
  EXPECT_EQ(held[57], rounds.odometry[57]);
  EXPECT_NEAR(a.chi2_end, b.chi2_end, 1e-6 * a.chi2_end);
  EXPECT_NEAR(a.chi2_end, c.chi2_end, 1e-6 * a.chi2_end);
  for (std::size_t i = 0; i < here.size(); ++i) {
    const Se2 from_there = there[0].inverse() * there[i], from_held = held[0].inverse() * held[i];
    const Se2 from_here = here[0].inverse() * here[i];
    EXPECT_LT((from_here.translation() - from_there.translation()).norm(), 1e-8) << i;
    EXPECT_LT((from_here.translation() - from_held.translation()).norm(), 1e-8) << i;
  }
}

TEST(Solve, AtTheOptimumNoSmallMoveOfAnyNodeIsBetter) {
  const Rounds rounds = three_rounds(4, 0.02, 0.01);
  std::vector<Se2> poses = rounds.odometry;
  const SolveReport report = solve(poses, rounds.edges, exact());
  ASSERT_TRUE(report.solved);
  for (std::size_t i = 1; i < poses.size(); i += 7) {
    for (const Se2& move : {Se2{1e-4, 0, 0}, Se2{-1e-4, 0, 0}, Se2{0, 1e-4, 0}, Se2{0, -1e-4, 0},
                            Se2{0, 0, 1e-4}, Se2{0, 0, -1e-4}}) {
      std::vector<Se2> other = poses;
      other[i] = {poses[i].x_m + move.x_m, poses[i].y_m + move.y_m, poses[i].theta_rad + move.theta_rad};
      EXPECT_GT(total_chi2(other, rounds.edges), report.chi2_end) << i;
    }
  }
}

TEST(Solve, ChiSquareOfASmallGraphIsWhatIsReckonedByHand) {
  // Two ways between two nodes that disagree by d, of information w each: each gives way by d / 2, and what
  // is left is w d^2 / 2.
  std::vector<Se2> poses{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  std::vector<Edge> edges(2);
  for (Edge& edge : edges) edge.to = 1;
  edges[0].T_from_to = {1.0, 0.0, 0.0};
  edges[1].T_from_to = {1.2, 0.0, 0.0};
  edges[0].information = edges[1].information = 100.0 * Eigen::Matrix3d::Identity();
  const SolveReport report = solve(poses, edges, kGraphParams);
  EXPECT_NEAR(report.chi2_start, 4.0, 1e-12);
  EXPECT_NEAR(report.chi2_end, 2.0, 1e-12);
  EXPECT_NEAR(poses[1].x_m, 1.1, 1e-12);
}

TEST(StartLinearly, FindsTheOptimumFromPosesThatAreNoEstimateAtAll) {
  const Rounds rounds = three_rounds(5, 0.02, 0.01);
  std::vector<Se2> good = rounds.odometry, bad(rounds.odometry.size());
  std::mt19937 random(6);
  std::uniform_real_distribution<double> anywhere(-50.0, 50.0), any_way(-3.0, 3.0);
  for (std::size_t i = 1; i < bad.size(); ++i) bad[i] = {anywhere(random), anywhere(random), any_way(random)};
  bad[0] = good[0];
  const double optimum = solve(good, rounds.edges, exact()).chi2_end;
  ASSERT_TRUE(start_linearly(bad, rounds.edges));
  EXPECT_LT(total_chi2(bad, rounds.edges), 1.5 * optimum) << "a start in the right valley";
  EXPECT_NEAR(solve(bad, rounds.edges, exact()).chi2_end, optimum, 1e-9 * optimum);
}

TEST(StartLinearly, AGraphInTwoPiecesHasNone) {
  std::vector<Se2> poses = circle(4, 1.0);
  const std::vector<Se2> before = poses;
  const std::vector<Edge> edges{between(poses, 0, 1), between(poses, 2, 3)};
  EXPECT_FALSE(start_linearly(poses, edges));
  EXPECT_EQ(poses, before);
}

TEST(SpanningStart, IsTheDeadReckoningAtAStampThatHasOne) {
  Rounds rounds = three_rounds(7, 0.05, 0.02);
  std::rotate(rounds.edges.begin(), rounds.edges.begin() + 119, rounds.edges.end());
  const auto start = spanning_start(rounds.truth.size(), rounds.edges, rounds.truth[0]);
  ASSERT_TRUE(start);
  for (std::size_t i = 0; i < start->size(); ++i)
    EXPECT_LT(((*start)[i].translation() - rounds.odometry[i].translation()).norm(), 1e-9) << i;
}

TEST(SpanningStart, BridgesAGapByAnotherEdgeAgainstItsDirection) {
  const std::vector<Se2> truth = circle(6, 2.0);
  const std::vector<Edge> edges{between(truth, 0, 1), between(truth, 2, 1), between(truth, 5, 2),
                                between(truth, 4, 5), between(truth, 3, 4)};
  const auto start = spanning_start(6, edges, truth[0]);
  ASSERT_TRUE(start);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_LT(((*start)[i].translation() - truth[i].translation()).norm(), 1e-12) << i;
  EXPECT_FALSE(spanning_start(7, edges));
}

TEST(Solve, ADisconnectedNodeIsSaidNotInvented) {
  std::vector<Se2> poses = circle(4, 1.0);
  const std::vector<Se2> before = poses;
  const std::vector<Edge> edges{between(poses, 0, 1)};
  const SolveReport report = solve(poses, edges, kGraphParams);
  EXPECT_FALSE(report.solved);
  EXPECT_EQ(poses, before);
}

TEST(EdgeError, IsZeroAtTheMeasurement) {
  const std::vector<Se2> poses = circle(7, 3.0);
  EXPECT_LT(edge_error(between(poses, 2, 5), poses[2], poses[5]).norm(), 1e-12);
}

TEST(SolveConsistently, LeavesOutTheClosureThatOthersContradict) {
  // A straight way of eleven stations, three true closures along it and a false one that folds it.
  std::vector<Se2> truth;
  for (int i = 0; i <= 10; ++i) truth.push_back({1.0 * i, 0.0, 0.0});
  const auto between = [&](std::size_t from, std::size_t to, bool robust) {
    Edge edge;
    edge.from = from;
    edge.to = to;
    edge.T_from_to = truth[from].inverse() * truth[to];
    edge.information = Eigen::Vector3d(400.0, 400.0, 4000.0).asDiagonal();
    edge.robust = robust;
    return edge;
  };
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < 10; ++i) edges.push_back(between(i, i + 1, false));
  for (const std::size_t from : {0U, 3U, 6U}) edges.push_back(between(from, from + 4, true));
  Edge wrong = between(0, 10, true);
  wrong.T_from_to = {7.0, 1.0, 0.3};
  for (std::size_t at = 10; at <= edges.size(); ++at) {
    std::vector<Edge> all = edges;
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(at), wrong);
    std::vector<Se2> robust = truth, consistent = truth;
    ASSERT_TRUE(solve(robust, all, {}).solved);
    ASSERT_TRUE(solve_consistently(consistent, all, {}).solved);
    EXPECT_GT((robust[10].translation() - truth[10].translation()).norm(), 1e-3) << "the loss alone bends it";
    EXPECT_LT((consistent[10].translation() - truth[10].translation()).norm(), 1e-6);
  }
}

TEST(SolveConsistently, KeepsTheOnlyTieOfAPieceHoweverFarOff) {
  std::vector<Se2> poses{{}, {1.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, {6.0, 0.0, 0.0}};
  const auto tie = [](std::size_t from, std::size_t to, const Se2& T_from_to) {
    Edge edge;
    edge.from = from;
    edge.to = to;
    edge.T_from_to = T_from_to;
    edge.information = 1000.0 * Eigen::Matrix3d::Identity();
    edge.robust = true;
    return edge;
  };
  // Two closures of like weight to the other piece, on either side of where it lies: neither wins.
  std::vector<Edge> edges{tie(0, 1, {1.0, 0.0, 0.0}), tie(2, 3, {1.0, 0.0, 0.0}), tie(0, 2, {5.0, 5.0, 0.0}),
                          tie(0, 2, {5.0, -5.0, 0.0})};
  edges[0].robust = edges[1].robust = false;
  std::vector<Se2> with_both = poses;
  ASSERT_TRUE(solve(with_both, edges, {}).solved);
  for (const std::size_t closure : {2U, 3U})
    ASSERT_GT(edge_chi2(edges[closure], with_both), GraphParams{}.contradicted_chi2)
        << "each contradicts the other";
  ASSERT_TRUE(solve_consistently(poses, edges, {}).solved);
  EXPECT_EQ(poses, with_both);
}

TEST(EdgeError, IsTheSameInAnyFrame) {
  std::mt19937 random(21);
  for (int k = 0; k < 50; ++k) {
    const auto poses = testing::random_poses(2, random);
    const Edge edge = testing::measured(poses, 0, 1, {0.3, -0.2, 0.1});
    const Se2 frame = testing::random_pose(random);
    const Eigen::Vector3d here = edge_error(edge, poses[0], poses[1]);
    EXPECT_LT((edge_error(edge, frame * poses[0], frame * poses[1]) - here).norm(), 1e-9);
    // What the measurement errs by is the way back from it.
    const Se2 back = Se2{0.3, -0.2, 0.1}.inverse();
    EXPECT_LT((here - Eigen::Vector3d(back.x_m, back.y_m, back.theta_rad)).norm(), 1e-9);
  }
}

TEST(TotalChi2, IsTheSumOverTheEdges) {
  std::mt19937 random(22);
  const auto poses = testing::random_poses(10, random);
  const auto edges = testing::measured_ties(poses, testing::random_ties(10, 8, random), 0.1, random);
  double sum = 0.0;
  for (const Edge& edge : edges) {
    const Eigen::Vector3d error = edge_error(edge, poses[edge.from], poses[edge.to]);
    EXPECT_NEAR(edge_chi2(edge, poses), error.dot(edge.information * error), 1e-12);
    EXPECT_GE(edge_chi2(edge, poses), 0.0);
    sum += edge_chi2(edge, poses);
  }
  EXPECT_NEAR(total_chi2(poses, edges), sum, 1e-9 * sum);
  EXPECT_EQ(total_chi2(poses, {}), 0.0);
}

TEST(Solve, EdgesThatAgreeGiveTheTruth) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const std::size_t nodes = 2 + random() % 20, fixed = random() % nodes;
    const auto truth = testing::random_poses(nodes, random);
    const auto edges = testing::measured_ties(truth, testing::random_ties(nodes, nodes, random), 0.0, random);
    std::normal_distribution<double> off(0.0, 0.05);
    std::vector<Se2> poses = truth;
    for (std::size_t i = 0; i < nodes; ++i)
      if (i != fixed) poses[i] = poses[i] * Se2{off(random), off(random), off(random)};
    const SolveReport report = solve(poses, edges, exact(), fixed);
    ASSERT_TRUE(report.solved) << seed;
    EXPECT_LT(testing::greatest_difference(poses, truth), 1e-6) << seed;
    EXPECT_LE(report.chi2_end, report.chi2_start) << seed;
    EXPECT_NEAR(report.chi2_end, total_chi2(poses, edges), 1e-9 + 1e-6 * report.chi2_end) << seed;
  }
}

TEST(Solve, ARobustEdgeThatFitsIsAsGoodAsAnother) {
  std::mt19937 random(23);
  const auto truth = testing::random_poses(8, random);
  auto edges = testing::measured_ties(truth, testing::random_ties(8, 6, random), 0.0, random);
  for (Edge& edge : edges) edge.robust = true;
  std::vector<Se2> poses = truth;
  for (std::size_t i = 1; i < poses.size(); ++i) poses[i] = poses[i] * Se2{0.02, -0.01, 0.01};
  ASSERT_TRUE(solve(poses, edges, exact()).solved);
  EXPECT_LT(testing::greatest_difference(poses, truth), 1e-6);
}

/// A chain of steps that measure 2.2 m between ends that are held 2 m apart: each step gives way alike, and
/// the ends stay where they are. The linear start, exact without turns, is there at once.
TEST(PoseGraph, SeveralFixedNodesStay) {
  const std::vector<types::Se2> start{{0, 0, 0}, {1, 0.3, 0.1}, {2, 0, 0}};
  std::vector<Edge> edges(2);
  edges[0].to = edges[1].from = 1;
  edges[1].to = 2;
  for (Edge& edge : edges) edge.T_from_to = {1.1, 0, 0};
  const std::size_t ends[] = {0, 2};
  std::vector<types::Se2> solved = start, linear = start, held = start;
  const SolveReport report = solve(solved, edges, exact(), ends);
  EXPECT_TRUE(report.solved);
  EXPECT_NEAR(report.chi2_end, 0.02, 1e-9);
  ASSERT_TRUE(start_linearly(linear, edges, ends));
  for (const auto* poses : {&solved, &linear}) {
    EXPECT_EQ((*poses)[0], start[0]);
    EXPECT_EQ((*poses)[2], start[2]);
    EXPECT_NEAR((*poses)[1].x_m, 1.0, 1e-6);
    EXPECT_NEAR((*poses)[1].y_m, 0.0, 1e-6);
  }
  const std::size_t all[] = {0, 1, 2};
  EXPECT_TRUE(solve(held, edges, exact(), all).solved);
  EXPECT_EQ(held, start);
}

}  // namespace
}  // namespace topo::slam

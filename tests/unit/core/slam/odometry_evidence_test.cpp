// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/odometry_evidence.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "core/slam/information.hpp"
#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// Keyframes of one run along a path, a second apart, whose odometry is the path itself.
std::vector<KeyframePtr> keyframes_along(std::span<const Se2> odometry) {
  std::vector<KeyframePtr> keyframes;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    auto keyframe = std::make_shared<Keyframe>();
    keyframe->id = {3, static_cast<std::uint32_t>(i), 1};
    keyframe->stamp = types::stamp_from_seconds(static_cast<double>(i));
    keyframe->T_odom_base = odometry[i];
    keyframes.push_back(std::move(keyframe));
  }
  return keyframes;
}

Eigen::Matrix3d as_certain_as_a_match() {
  return Eigen::Vector3d(1.0 / (0.03 * 0.03), 1.0 / (0.03 * 0.03), 1.0 / (0.003 * 0.003)).asDiagonal();
}

Edge match_between(std::span<const Se2> poses, std::size_t from, std::size_t to, const Se2& error = {}) {
  Edge edge = testing::measured(poses, from, to, error);
  edge.information = as_certain_as_a_match();
  return edge;
}

TEST(OdometryEvidence, AddsNothingWhereItAgrees) {
  EXPECT_TRUE(rc::check("within its noise", [] {
    const auto part = [] { return *rc::gen::inRange(-100, 101) / 100.0; };
    const std::vector<Se2> odometry{{}, {1.0, 0.0, part()}};
    const double limit = std::sqrt(OdometryEvidenceParams{}.doubted_chi2);
    const Eigen::Matrix3d information = motion_information(odometry[1], {});
    Eigen::Vector3d off(part(), part(), part());
    RC_PRE(off.norm() > 0.01);
    off *= *rc::gen::inRange(0, 99) / 100.0 * limit / std::sqrt(off.dot(information * off));
    const std::vector<Edge> edges{match_between(odometry, 0, 1, {off.x(), off.y(), off.z()})};
    const auto all = with_odometry(keyframes_along(odometry), edges, {});
    RC_ASSERT(all.size() == 1U);
    RC_ASSERT(!(all.front().doubt_chi2 > 0.0));
  }));
}

TEST(OdometryEvidence, StandsBesideAMatchThatItContradicts) {
  const std::vector<Se2> odometry{{4.0, 1.0, 0.5}, {4.8, 1.2, 0.9}};
  const std::vector<Edge> edges{match_between(odometry, 0, 1, {0.0, 0.0, 0.5})};
  const auto all = with_odometry(keyframes_along(odometry), edges, {});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_GT(all[0].doubt_chi2, 1.0);
  EXPECT_TRUE(all[1].robust);
  EXPECT_LT(testing::difference(all[1].T_from_to, odometry[0].inverse() * odometry[1]), 1e-12);
  EXPECT_LT(all[1].information.trace(), edges[0].information.trace()) << "weaker than a match";
}

TEST(OdometryEvidence, IsNoneOfAResetOfAPushedRobotAndOfAnotherRun) {
  const Se2 false_turn{0.0, 0.0, 1.0};
  std::vector<Se2> odometry{{}, {1.0, 0.0, 0.0}};
  auto keyframes = keyframes_along(odometry);
  const std::vector<Edge> match{match_between(odometry, 0, 1, false_turn)};
  ASSERT_EQ(with_odometry(keyframes, match, {}).size(), 2U);
  EXPECT_EQ(with_odometry(keyframes_along(std::vector<Se2>{{}, {90.0, 0.0, 0.0}}), match, {}).size(), 1U);
  EXPECT_EQ(with_odometry(keyframes_along(std::vector<Se2>{{}, {}}), match, {}).size(), 1U);
  auto other_run = std::make_shared<Keyframe>(*keyframes[1]);
  other_run->id.run = 2;
  keyframes[1] = other_run;
  EXPECT_EQ(with_odometry(keyframes, match, {}).size(), 1U);
}

/// A robot goes twice round a square of 15 m, a keyframe every metre. One match of the first round turns it
/// 0.25 rad too far and puts it 0.5 m ahead; odometry is right. Closures tie the second round to the first;
/// those from keyframe `no_more_along` on do not measure the way along (a corridor).
struct TwoRounds {
  explicit TwoRounds(std::size_t no_more_along) {
    for (int i = 0; i < 120; ++i) {
      const int leg = i / 15 % 4;
      const double along = i % 15;
      const double x[] = {along, 15.0, 15.0 - along, 0.0}, y[] = {0.0, along, 15.0, 15.0 - along};
      truth.push_back({x[leg], y[leg], types::wrap_angle(leg * std::numbers::pi / 2.0)});
    }
    keyframes = keyframes_along(truth);
    for (std::size_t i = 0; i + 1 < truth.size(); ++i)
      edges.push_back(match_between(truth, i, i + 1, i == kFalse ? Se2{0.5, 0.0, 0.25} : Se2{}));
    for (std::size_t i = 60; i < truth.size(); i += 3) {
      edges.push_back(match_between(truth, i - 60, i));
      edges.back().robust = true;
      edges.back().information(2, 2) = 1.0 / (0.008 * 0.008);
      if (i >= no_more_along) edges.back().information(0, 0) = 0.0;
    }
    poses.push_back({});
    for (std::size_t i = 0; i + 1 < truth.size(); ++i) poses.push_back(poses.back() * edges[i].T_from_to);
  }
  [[nodiscard]] double off_m(std::span<const Edge> of, const GraphParams& params = {}) const {
    std::vector<Se2> solved = poses;
    if (!solve_consistently(solved, of, params).solved) return HUGE_VAL;
    double off = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) off = std::max(off, distance_m(solved[i], truth[i]));
    return off;
  }
  [[nodiscard]] std::vector<Edge> evidence() const { return with_odometry(keyframes, edges, {}); }

  static constexpr std::size_t kFalse = 10;
  std::vector<Se2> truth, poses;
  std::vector<KeyframePtr> keyframes;
  std::vector<Edge> edges;
};

TEST(OdometryEvidence, LaterClosuresOverruleAMatchThatItContradicts) {
  const TwoRounds rounds(120);
  EXPECT_LT(rounds.off_m(rounds.evidence()), 0.02);
}

TEST(OdometryEvidence, WithoutTheLossTheFalseMatchBendsTheWay) {
  const TwoRounds rounds(120);
  std::vector<Edge> squares = rounds.evidence();
  for (Edge& edge : squares) edge.doubt_chi2 = 0.0;
  EXPECT_GT(rounds.off_m(squares), 0.2);
  EXPECT_GT(rounds.off_m(rounds.edges), 0.2) << "nor without doubt";
}

TEST(OdometryEvidence, ItsEdgeMeasuresWhatTheClosuresDoNot) {
  const TwoRounds rounds(60);
  std::vector<Edge> without = rounds.evidence();
  EXPECT_LT(rounds.off_m(without), 0.1);
  std::erase_if(without, [](const Edge& edge) { return edge.robust && edge.from + 1 == edge.to; });
  EXPECT_GT(rounds.off_m(without), 0.2);
}

TEST(OdometryEvidence, AMatchThatNoClosureContradictsStandsHoweverFarFromOdometry) {
  TwoRounds rounds(120);
  rounds.edges.resize(rounds.truth.size() - 1);  // no closures
  std::vector<Se2> solved = rounds.poses;
  ASSERT_TRUE(solve_consistently(solved, rounds.evidence(), {}).solved);
  for (std::size_t i = 0; i < solved.size(); ++i) EXPECT_LT(distance_m(solved[i], rounds.poses[i]), 0.5) << i;
}

}  // namespace
}  // namespace topo::slam

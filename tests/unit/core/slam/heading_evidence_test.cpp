// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/heading_evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/slam/graph_solution.hpp"
#include "core/slam/wall_direction.hpp"
#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

constexpr double kDegree_rad = std::numbers::pi / 180.0;

/// Keyframes a metre apart that go round a block, in a building with this direction. Odometry is what the
/// matches say. One of the matches errs.
struct Way {
  explicit Way(double building_rad, double error_rad = 0.0) {
    for (int i = 0; i < 80; ++i) {
      const int leg = i / 20;
      const double along = i % 20;
      const double x[] = {along, 20.0, 20.0 - along, 0.0}, y[] = {0.0, along, 20.0, 20.0 - along};
      truth.push_back({x[leg], y[leg], types::wrap_angle(leg * std::numbers::pi / 2.0)});
    }
    for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
      edges.push_back(testing::measured(truth, i, i + 1, i == kFalse ? Se2{0.0, 0.0, error_rad} : Se2{}));
      edges.back().information =
          Eigen::Vector3d(1.0 / (0.03 * 0.03), 1.0 / (0.03 * 0.03), 1.0 / (0.003 * 0.003)).asDiagonal();
    }
    poses.push_back({});
    for (const Edge& edge : edges) poses.push_back(poses.back() * edge.T_from_to);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      auto keyframe = std::make_shared<Keyframe>();
      keyframe->id = {3, static_cast<std::uint32_t>(i), 1};
      keyframe->stamp = types::stamp_from_seconds(static_cast<double>(i));
      keyframe->T_odom_base = poses[i];
      keyframe->walls_rad = building_rad - truth[i].theta_rad;
      keyframes.push_back(std::move(keyframe));
    }
  }
  void see_walls(std::size_t from, std::size_t to, double turned_rad) {
    for (std::size_t i = from; i < to; ++i) {
      auto keyframe = std::make_shared<Keyframe>(*keyframes[i]);
      keyframe->walls_rad = *keyframe->walls_rad + turned_rad;
      keyframes[i] = std::move(keyframe);
    }
  }
  void see_nothing() {
    for (KeyframePtr& keyframe : keyframes) {
      auto blind = std::make_shared<Keyframe>(*keyframe);
      blind->walls_rad.reset();
      keyframe = std::move(blind);
    }
  }
  [[nodiscard]] GraphSolution solved() const { return solve_settled(keyframes, poses, edges, 0, {}); }
  /// Greatest error of a heading, from a keyframe on.
  [[nodiscard]] double off_deg(std::size_t first = 0) const {
    const GraphSolution solution = solved();
    EXPECT_TRUE(solution.report.solved);
    double off_rad = 0.0;
    for (std::size_t i = first; i < truth.size(); ++i)
      off_rad =
          std::max(off_rad, std::abs(types::wrap_angle(solution.poses[i].theta_rad - truth[i].theta_rad)));
    return off_rad / kDegree_rad;
  }

  static constexpr std::size_t kFalse = 30;
  std::vector<Se2> truth, poses;
  std::vector<Edge> edges;
  std::vector<KeyframePtr> keyframes;
};

TEST(HeadingEvidence, StraightensAWayThatNoPlaceFoundAgainCloses) {
  Way way(0.4, 4.0 * kDegree_rad);
  EXPECT_LT(way.off_deg(), 2.0) << "a certain match bends what is beside it";
  EXPECT_LT(way.off_deg(Way::kFalse + 20), 0.3);
  way.see_nothing();
  EXPECT_NEAR(way.off_deg(Way::kFalse + 20), 4.0, 0.01) << "without walls it stays as bent as the match";
}

TEST(HeadingEvidence, ChangesNothingOfAMapThatIsRight) {
  const Way way(0.4);
  EXPECT_LT(way.off_deg(), 1e-6);
}

TEST(HeadingEvidence, HowTheBuildingLiesInTheMapDoesNotMatter) {
  const GraphSolution first = Way(0.1, 3.0 * kDegree_rad).solved();
  for (const double building_rad : {0.4, 1.2, -2.0}) {
    const GraphSolution other = Way(building_rad, 3.0 * kDegree_rad).solved();
    ASSERT_EQ(other.poses.size(), first.poses.size());
    EXPECT_EQ(other.poses[0], Se2{}) << "the map stays where it is";
    for (std::size_t i = 0; i < first.poses.size(); ++i) {
      EXPECT_NEAR(other.poses[i].x_m, first.poses[i].x_m, 1e-3);
      EXPECT_NEAR(other.poses[i].theta_rad, first.poses[i].theta_rad, 1e-4);
    }
  }
}

TEST(HeadingEvidence, TheFixedKeyframeStaysWhereverItIs) {
  const Way way(0.4, 3.0 * kDegree_rad);
  const std::size_t fixed = 40;
  const GraphSolution first = solve_settled(way.keyframes, way.poses, way.edges, fixed, {});
  const Se2 moved{7.0, -3.0, 2.5};
  std::vector<Se2> poses;
  for (const Se2& pose : way.poses) poses.push_back(moved * pose);
  const GraphSolution second = solve_settled(way.keyframes, poses, way.edges, fixed, {});
  ASSERT_TRUE(first.report.solved && second.report.solved);
  EXPECT_EQ(first.poses[fixed], way.poses[fixed]);
  EXPECT_EQ(second.poses[fixed], poses[fixed]);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Se2 off = (moved * first.poses[i]).inverse() * second.poses[i];
    EXPECT_LT(std::hypot(off.x_m, off.y_m), 1e-3);
    EXPECT_LT(std::abs(off.theta_rad), 1e-4);
  }
}

// A limit, not a wish: a part less than the gate askew is drawn straight where no closure says otherwise.
TEST(HeadingEvidence, APartAskewByLessThanTheGateIsDrawnStraight) {
  Way way(0.4);
  way.see_walls(50, 80, 4.0 * kDegree_rad);
  EXPECT_NEAR(way.off_deg(), 4.0, 0.3);
}

TEST(HeadingEvidence, ASkewWingKeepsItsDirection) {
  Way way(0.4);
  way.see_walls(50, 80, 12.0 * kDegree_rad);
  EXPECT_LT(way.off_deg(), 1e-6);
  const auto building_rad = building_directions(way.keyframes, way.poses, {});
  ASSERT_EQ(building_rad.size(), 2U);
  EXPECT_NEAR(building_rad[0], 0.4, 1e-6) << "that with most keyframes is the first";
  EXPECT_NEAR(types::within_quarter(building_rad[1] - 0.4) / kDegree_rad, 12.0, 1e-6);
  EXPECT_EQ(walls_against(*way.keyframes[60], way.poses[60], building_rad)->wing, 1U);
  EXPECT_EQ(heading_evidence(way.keyframes, way.poses, {}).size(), 50U);
}

TEST(HeadingEvidence, ACrookedBuildingSaysNothing) {
  Way way(0.4, 4.0 * kDegree_rad);
  for (std::size_t i = 0; i < way.keyframes.size(); ++i)
    way.see_walls(i, i + 1, 7.0 * static_cast<double>(i) * kDegree_rad);
  EXPECT_TRUE(building_directions(way.keyframes, way.poses, {}).empty());
  EXPECT_TRUE(heading_evidence(way.keyframes, way.poses, {}).empty());
  EXPECT_FALSE(walls_against(*way.keyframes[0], way.poses[0], {}));
}

TEST(HeadingEvidence, WallsTieNoKeyframeToTheMap) {
  Way way(0.4);
  way.edges.erase(way.edges.begin() + 40);
  EXPECT_FALSE(way.solved().report.solved) << "the walls say nothing of where the rest lies";
}

}  // namespace
}  // namespace topo::slam

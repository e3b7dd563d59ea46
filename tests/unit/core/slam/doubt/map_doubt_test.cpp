// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/doubt/map_doubt.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// A map of nothing.
MapDoubt doubt_of(const ScanCount& scans, const RevisitShare& revisits = {}) {
  return slam::doubt_of({}, {}, {}, scans, revisits);
}

TEST(MapDoubt, DoubtsAMapOfLostScans) {
  EXPECT_EQ(doubt_of({1006, 1005}).reason, DoubtReason::kLost);
  EXPECT_TRUE(doubt_of({100, 11}).is_doubted());
  EXPECT_FALSE(doubt_of({100, 10}).is_doubted());
  EXPECT_FALSE(doubt_of({1, 0}).is_doubted());
}

TEST(MapDoubt, DoubtsAMapWhoseWallsStandTwice) {
  RevisitShare revisits{10'000, 9'000, {{{2.5, 2.5}, 8000, 7900}, {{7.5, 2.5}, 2000, 600}}};
  const MapDoubt doubt = doubt_of({100, 0}, revisits);
  EXPECT_TRUE(doubt.is_doubted());
  EXPECT_EQ(doubt.reason, DoubtReason::kContradicted);
  EXPECT_DOUBLE_EQ(doubt.contradicted, 0.2);
  ASSERT_EQ(doubt.regions.size(), 1U);
  EXPECT_DOUBLE_EQ(doubt.regions[0].centre.x(), 7.5);
  EXPECT_DOUBLE_EQ(contradicted_share(doubt.regions[0]), 0.7);
  revisits.regions[1].within = 1500;  // an open door
  EXPECT_FALSE(doubt_of({100, 0}, revisits).is_doubted());
  revisits.regions[1] = {{7.5, 2.5}, DoubtLimits{}.region_points - 1, 0};
  EXPECT_TRUE(doubt_of({100, 0}, revisits).regions.empty()) << "too few points";
}

TEST(MapDoubt, DoubtsAMapOfDegenerateStretches) {
  EXPECT_EQ(doubt_of({100, 0, 60}).reason, DoubtReason::kDegenerate);
  EXPECT_TRUE(doubt_of({100, 0, 60}).is_doubted());
  EXPECT_FALSE(doubt_of({100, 0, 40}).is_doubted());
}

/// A path of keyframes a metre and a second apart, whose odometry and matches agree with the poses.
struct Path {
  explicit Path(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      map.poses.push_back({static_cast<double>(i), 0.0, 0.0});
      auto keyframe = std::make_shared<Keyframe>();
      keyframe->id = {3, static_cast<std::uint32_t>(i), 1};
      keyframe->stamp = types::stamp_from_seconds(static_cast<double>(i));
      keyframe->T_odom_base = map.poses.back();
      map.keyframes.push_back(std::move(keyframe));
    }
    way.resize(count);
    std::iota(way.begin(), way.end(), 0U);
    for (std::size_t i = 1; i < count; ++i) step(i, 0.003);
  }
  void step(std::size_t to, double sigma_rad) {
    Edge edge = testing::measured(map.poses, to - 1, to);
    edge.information = Eigen::Vector3d(1e3, 1e3, 1.0 / (sigma_rad * sigma_rad)).asDiagonal();
    map.edges.push_back(edge);
  }
  void close(std::size_t from, std::size_t to, const Se2& error = {}) {
    Edge edge = testing::measured(map.poses, from, to, error);
    edge.information = 1e3 * Eigen::Matrix3d::Identity();
    edge.robust = true;
    map.edges.push_back(edge);
  }
  /// What odometry counts differs from the poses by this turn, from a keyframe on.
  void turn_odometry(std::size_t from, double rad) {
    const Se2 before = map.keyframes[from - 1]->T_odom_base;
    for (std::size_t i = from; i < map.keyframes.size(); ++i) {
      auto turned = std::make_shared<Keyframe>(*map.keyframes[i]);
      turned->T_odom_base = before * Se2{0.0, 0.0, rad} * (before.inverse() * map.keyframes[i]->T_odom_base);
      map.keyframes[i] = std::move(turned);
    }
  }
  /// The keyframes see walls of this direction in map, from one on.
  void see_walls(std::size_t from, double direction_rad) {
    for (std::size_t i = from; i < map.keyframes.size(); ++i) {
      auto seeing = std::make_shared<Keyframe>(*map.keyframes[i]);
      seeing->walls_rad = direction_rad - map.poses[i].theta_rad;
      map.keyframes[i] = std::move(seeing);
    }
  }
  [[nodiscard]] MapDoubt doubt() const { return slam::doubt_of(map, way, {}, {100, 0}, {}); }

  Session map;
  std::vector<std::size_t> way;
};

TEST(MapDoubt, BelievesAPathOfMatches) { EXPECT_LT(Path(100).doubt().figure, 0.1); }

TEST(MapDoubt, DoubtsATurnThatOdometryAloneCarries) {
  Path path(100);
  path.map.edges[49].information(2, 2) = 1.0 / (0.1 * 0.1);
  const MapDoubt doubt = path.doubt();
  EXPECT_NEAR(doubt.loose_rad, 0.1, 1e-9);
  EXPECT_TRUE(doubt.is_doubted());
  EXPECT_EQ(doubt.reason, DoubtReason::kLoose);
  ASSERT_EQ(doubt.loose.size(), 1U);
  EXPECT_EQ(doubt.loose[0].before, types::Vector2(49.0, 0.0));
  path.close(10, 90);
  EXPECT_FALSE(path.doubt().is_doubted()) << "a place was found again across it";
}

TEST(MapDoubt, WallsOfOneDirectionSayHowTheRobotTurned) {
  Path path(100);
  path.map.edges[49].information(2, 2) = 1.0 / (0.1 * 0.1);
  path.see_walls(0, 0.2);
  EXPECT_FALSE(path.doubt().is_doubted());
  EXPECT_TRUE(path.doubt().loose.empty());
  path.see_walls(50, 0.7);
  EXPECT_TRUE(path.doubt().is_doubted()) << "they are of another wing after the step";
  path.see_walls(50, 0.2);
  path.map.edges[49].information(2, 2) = 1.0 / (0.45 * 0.45);
  EXPECT_TRUE(path.doubt().is_doubted()) << "it may have turned by a quarter";
  path.map.edges[49].information(2, 2) = 1.0 / (0.35 * 0.35);
  EXPECT_FALSE(path.doubt().is_doubted());
  path.see_walls(80, 0.7);
  EXPECT_TRUE(path.doubt().is_doubted()) << "or from a wing half a radian askew into the other";
}

TEST(MapDoubt, DoubtsAWayThatOdometryAloneMeasures) {
  Path path(100);
  path.see_walls(0, 0.2);
  path.map.edges[49].information(0, 0) = 1.0 / (0.5 * 0.5);
  const MapDoubt doubt = path.doubt();
  EXPECT_NEAR(doubt.loose_m, 0.5, 1e-9);
  EXPECT_TRUE(doubt.is_doubted());
  EXPECT_EQ(doubt.reason, DoubtReason::kShifted);
  ASSERT_EQ(doubt.loose.size(), 1U);
  EXPECT_NEAR(doubt.loose[0].sigma_m, 0.5, 1e-9);
  path.close(10, 90);
  EXPECT_FALSE(path.doubt().is_doubted());
}

TEST(MapDoubt, DoubtsAMatchThatOdometryContradicts) {
  Path path(100);
  path.turn_odometry(50, 0.3);
  EXPECT_NEAR(path.doubt().loose_rad, 0.3, 0.01);
  path.close(10, 90);
  EXPECT_EQ(path.doubt().loose_rad, 0.0);
}

TEST(MapDoubt, OdometryThatContradictsManyMatchesIsItselfAtFault) {
  Path path(100);
  for (std::size_t i = 15; i < 100; i += 10) path.turn_odometry(i, 0.3);
  EXPECT_GT(path.doubt().loose_rad, 0.3) << "nine of 99 are not many";
  path.turn_odometry(50, 0.3);
  EXPECT_EQ(path.doubt().loose_rad, 0.0);
}

TEST(MapDoubt, DoubtsAMapWhoseClosuresContradictEachOther) {
  Path path(100);
  for (std::size_t i = 0; i < 8; ++i) path.close(i, 60 + i);
  path.close(20, 80, {1.0, 0.0, 0.0});
  EXPECT_NEAR(path.doubt().tension, 1.0 / 9.0, 1e-9);
  EXPECT_FALSE(path.doubt().is_doubted());
  path.close(21, 81, {1.0, 0.0, 0.0});
  path.close(22, 82, {1.0, 0.0, 0.0});
  EXPECT_TRUE(path.doubt().is_doubted());
  EXPECT_EQ(path.doubt().reason, DoubtReason::kTension);
}

}  // namespace
}  // namespace topo::slam

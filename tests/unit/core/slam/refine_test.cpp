// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/refine.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

const RefineParams kRefineParams;
const types::Se2 kTruth{3.5, 3.0, 0.4};

TEST(Refine, FindsTheTruePoseFromNearby) {
  std::mt19937 random(7);
  const mocks::FlatWorld world = mocks::two_rooms();
  const SurfelMap map =
      testing::map_of(world, {{3.0, 3.0, 0.0}, {4.0, 3.5, 1.0}, {4.5, 2.5, -1.0}}, 0.01, random);
  const testing::View view = testing::view_of(world, kTruth, 0.01, random);
  EXPECT_TRUE(rc::check("from any start within 15 cm and 5 degrees", [&] {
    const auto off = [](int range) { return *rc::gen::inRange(-range, range) / 1000.0; };
    const types::Se2 start{kTruth.x_m + off(150), kTruth.y_m + off(150), kTruth.theta_rad + off(87)};
    const Match match = refine(map, view.points, view.cloud.sensor, start, std::nullopt, kRefineParams);
    RC_ASSERT(std::abs(match.T_map_base.x_m - kTruth.x_m) < 0.01);
    RC_ASSERT(std::abs(match.T_map_base.y_m - kTruth.y_m) < 0.01);
    RC_ASSERT(std::abs(match.T_map_base.theta_rad - kTruth.theta_rad) < 0.004);
    RC_ASSERT(match.response > 0.9);
    RC_ASSERT(!match.degenerate);
  }));
}

TEST(Refine, TellsThatACorridorDoesNotFixThePlaceAlongIt) {
  std::mt19937 random(8);
  mocks::FlatWorld corridor;
  corridor.walls.push_back({{-60.0, -1.0}, {60.0, -1.0}});
  corridor.walls.push_back({{-60.0, 1.0}, {60.0, 1.0}});
  const SurfelMap map = testing::map_of(corridor, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, 0.01, random);
  const testing::View view = testing::view_of(corridor, {0.5, 0.1, 0.0}, 0.01, random);
  Prior prior{{0.62, 0.0, 0.02}, Eigen::Matrix3d::Identity() * 1e3};
  const Match match = refine(map, view.points, view.cloud.sensor, prior.T_map_base, prior, kRefineParams);
  EXPECT_TRUE(match.degenerate);
  EXPECT_NEAR(match.T_map_base.y_m, 0.1, 0.01) << "across, the scan decides";
  EXPECT_NEAR(match.T_map_base.theta_rad, 0.0, 0.005);
  EXPECT_NEAR(match.T_map_base.x_m, 0.62, 0.03) << "along, the odometry decides";
}

TEST(Refine, TheOtherFaceOfAThinWallIsAnotherSurface) {
  mocks::FlatWorld wall;
  wall.walls.push_back({{2.0, -5.0}, {2.0, 5.0}});
  std::mt19937 random(9);
  const SurfelMap map = testing::map_of(wall, {{0.0, 0.0, 0.0}}, 0.0, random);
  const types::Se2 behind{4.0, 0.0, std::numbers::pi};
  const testing::View view = testing::view_of(wall, behind, 0.0, random);
  EXPECT_EQ(evaluate(map, view.points, view.cloud.sensor, behind, kRefineParams).overlap, 0.0);
}

TEST(Refine, WithoutAnyOverlapThePriorStays) {
  SurfelMap map(0.35);
  map.reset({0.0F, 0.0F}, 5.0);
  const Prior prior{{1.0, 2.0, 0.3}, Eigen::Matrix3d::Identity()};
  const Match match =
      refine(map, std::vector<Point>{{1.0F, 0.0F}}, {}, prior.T_map_base, prior, kRefineParams);
  EXPECT_EQ(match.T_map_base, prior.T_map_base);
  EXPECT_EQ(match.response, 0.0);
  EXPECT_EQ(match.fit(), 0.0);
  EXPECT_TRUE(match.degenerate);
}

}  // namespace
}  // namespace topo::slam

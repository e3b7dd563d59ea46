// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/refine.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

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

/// A map of one surfel at the middle of a cell, and a robot that looks at it.
SurfelMap one_surfel(const Point& normal, bool planar) {
  SurfelMap map(0.35);
  map.reset({0.0F, 0.0F}, 5.0);
  map.add(std::vector<Surfel>{{Point(2.05F, 0.05F), normal, planar}}, {});
  return map;
}

TEST(Evaluate, OfOnePointIsWhatIsReckonedByHand) {
  const SurfelMap map = one_surfel(Point(-1.0F, 0.0F), true);
  for (const float off : {0.0F, 0.04F, -0.04F, 0.15F}) {
    const std::vector<Point> point{Point(2.05F + off, 0.05F)};
    const Match match = evaluate(map, point, Point::Zero(), {}, kRefineParams);
    const auto r = static_cast<double>(off);
    const double weight = 1.0 / (kRefineParams.point_sigma_m * kRefineParams.point_sigma_m) /
                          (1.0 + std::pow(r / kRefineParams.kernel_m, 2));
    EXPECT_EQ(match.overlap, 1.0);
    EXPECT_EQ(match.response, std::abs(r) < kRefineParams.inlier_m ? 1.0 : 0.0);
    EXPECT_NEAR(match.rms_m, std::abs(r) < kRefineParams.inlier_m ? std::abs(r) : 0.0, 1e-6);
    // The wall is across x; a turn moves the point by its y.
    EXPECT_NEAR(match.scan_information(0, 0), weight, 1e-3 * weight);
    EXPECT_NEAR(match.scan_information(1, 1), 0.0, 1e-9);
    EXPECT_NEAR(match.scan_information(2, 2), weight * 0.05 * 0.05, 1e-5 * weight);
  }
}

TEST(Evaluate, APointFixesAPoleInBothDirections) {
  const SurfelMap map = one_surfel(Point(-1.0F, 0.0F), false);
  const Match match =
      evaluate(map, std::vector<Point>{Point(2.05F, 0.02F)}, Point::Zero(), {}, kRefineParams);
  EXPECT_GT(match.scan_information(0, 0), 0.0);
  EXPECT_NEAR(match.scan_information(0, 0), match.scan_information(1, 1), 1e-9);
  EXPECT_NEAR(match.rms_m, 0.03, 1e-6) << "in whatever direction it is off";
}

TEST(Evaluate, IsTheSumOfTheEvidenceOfItsPoints) {
  std::mt19937 random(10);
  const mocks::FlatWorld world = mocks::two_rooms();
  const SurfelMap map = testing::map_of(world, {{3.0, 3.0, 0.0}, {4.0, 3.5, 1.0}}, 0.01, random);
  const testing::View view = testing::view_of(world, kTruth, 0.03, random);
  const types::Se2 pose{3.58, 2.97, 0.43};
  const auto of = [&](std::span<const Point> points) {
    return evaluate(map, points, view.cloud.sensor, pose, kRefineParams);
  };
  const Match all = of(view.points);
  EXPECT_EQ(all.T_map_base, pose) << "it is not moved";
  EXPECT_EQ(all.scan_information, all.scan_information.transpose());
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double response = 0.0, overlap = 0.0, square = 0.0;
  for (const Point& p : view.points) {
    const Match one = of({&p, 1});
    information += one.scan_information;
    response += one.response;
    overlap += one.overlap;
    square += one.rms_m * one.rms_m;
  }
  const auto count = static_cast<double>(view.points.size());
  EXPECT_LT((information - all.scan_information).norm(), 1e-9 * information.norm());
  EXPECT_NEAR(all.response, response / count, 1e-12);
  EXPECT_NEAR(all.overlap, overlap / count, 1e-12);
  EXPECT_NEAR(all.rms_m, std::sqrt(square / response), 1e-9);
  EXPECT_NEAR(all.fit(), response / overlap, 1e-12);
}

TEST(Refine, APriorThatIsSureHoldsThePose) {
  std::mt19937 random(12);
  const mocks::FlatWorld world = mocks::two_rooms();
  const SurfelMap map = testing::map_of(world, {{3.0, 3.0, 0.0}, {4.0, 3.5, 1.0}}, 0.01, random);
  const testing::View view = testing::view_of(world, kTruth, 0.01, random);
  const types::Se2 believed{kTruth.x_m + 0.08, kTruth.y_m - 0.05, kTruth.theta_rad + 0.02};
  double before = 0.0;
  for (const double sure : {1e12, 1e6, 1e4, 1e-3}) {
    const Prior prior{believed, sure * Eigen::Matrix3d::Identity()};
    const Match match = refine(map, view.points, view.cloud.sensor, kTruth, prior, kRefineParams);
    const double moved = distance_m(match.T_map_base, believed);
    EXPECT_GE(moved, before - 1e-3) << "the less sure, the further the scan moves it: " << sure;
    EXPECT_LE(match.iterations, kRefineParams.iterations_max);
    before = moved;
    if (sure == 1e12) {
      EXPECT_LT(moved, 1e-4);
    }
  }
  EXPECT_GT(before, 0.08);
}

}  // namespace
}  // namespace topo::slam

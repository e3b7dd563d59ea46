// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/information.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

constexpr double kTransFloor_m = 0.03, kRotFloor_rad = 0.008;

Eigen::Matrix3d floored(const Eigen::Matrix3d& information_map, double theta_rad) {
  return edge_information(information_map, theta_rad, kTransFloor_m, kRotFloor_rad);
}

double least_eigenvalue(const Eigen::Matrix3d& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix).eigenvalues()(0);
}

Eigen::Matrix3d turn_about_z(double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// Of one information along each axis alone, with the floor's variance added.
double with_floor(double information, double floor) { return 1.0 / (1.0 / information + floor * floor); }

TEST(EdgeInformation, OfIndependentAxesAddsVariances) {
  const Eigen::Vector3d information(400.0, 2500.0, 1e4);
  const Eigen::Matrix3d ahead = floored(information.asDiagonal(), 0.0);
  const Eigen::Matrix3d left = floored(information.asDiagonal(), std::numbers::pi / 2.0);
  EXPECT_NEAR(ahead(0, 0), with_floor(400.0, kTransFloor_m), 1e-4);
  EXPECT_NEAR(ahead(1, 1), with_floor(2500.0, kTransFloor_m), 1e-4);
  EXPECT_NEAR(ahead(2, 2), with_floor(1e4, kRotFloor_rad), 1e-3);
  EXPECT_NEAR(left(0, 0), ahead(1, 1), 1e-6) << "the map's y is ahead of who looks that way";
  EXPECT_NEAR(left(1, 1), ahead(0, 0), 1e-6);
  EXPECT_NEAR(left(2, 2), ahead(2, 2), 1e-6);
  EXPECT_LT((ahead - Eigen::Matrix3d(ahead.diagonal().asDiagonal())).norm(), 1e-9);
}

TEST(EdgeInformation, IsSymmetricPositiveAndBelowTheFloors) {
  const Eigen::Matrix3d most =
      Eigen::Vector3d(std::pow(kTransFloor_m, -2), std::pow(kTransFloor_m, -2), std::pow(kRotFloor_rad, -2))
          .asDiagonal();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3.1, 3.1), power(-3.0, 8.0);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Matrix3d information =
        floored(std::pow(10.0, power(random)) * testing::random_positive<3>(0.0, random), angle(random));
    EXPECT_EQ(information, information.transpose());
    EXPECT_GT(least_eigenvalue(information), 0.0);
    EXPECT_GT(least_eigenvalue(most - information), 0.0) << k;
  }
}

TEST(EdgeInformation, TurnsWithTheMap) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Matrix3d information = 1e3 * testing::random_positive<3>(0.1, random);
    const double theta_rad = angle(random), turn_rad = angle(random);
    const Eigen::Matrix3d turn = turn_about_z(turn_rad);
    const Eigen::Matrix3d here = floored(information, theta_rad);
    EXPECT_LT((floored(turn * information * turn.transpose(), theta_rad + turn_rad) - here).norm(),
              1e-9 * here.norm());
  }
}

TEST(EdgeInformation, MoreEvidenceIsNeverLessInformation) {
  std::mt19937 random(3);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Matrix3d some = 100.0 * testing::random_positive<3>(0.0, random);
    const Eigen::Matrix3d more = some + 100.0 * testing::random_positive<3>(0.0, random);
    const Eigen::Matrix3d gain = floored(more, 0.7) - floored(some, 0.7);
    EXPECT_GT(least_eigenvalue(gain), -1e-6) << k;
  }
}

TEST(EdgeInformation, WithoutEvidenceAKilometreIsPossible) {
  const Eigen::Matrix3d none = floored(Eigen::Matrix3d::Zero(), 0.4);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(1.0 / std::sqrt(none(i, i)), 1000.0, 1.0);
}

TEST(MotionInformation, OfNoMotionIsTheFloors) {
  const MotionNoise noise;
  const Eigen::Matrix3d still = motion_information({}, noise);
  EXPECT_NEAR(still(0, 0) * noise.trans_floor_m * noise.trans_floor_m, 1.0, 1e-12);
  EXPECT_NEAR(still(2, 2) * noise.rot_floor_rad * noise.rot_floor_rad, 1.0, 1e-12);
}

TEST(MotionInformation, GrowsLessWithTheWayAndTheTurn) {
  const MotionNoise noise;
  double trans_before = HUGE_VAL, rot_before = HUGE_VAL;
  for (double way = 0.0; way < 3.0; way += 0.25) {
    const Eigen::Matrix3d information = motion_information({way, 0.0, 0.3}, noise);
    EXPECT_LT(information(0, 0), trans_before);
    EXPECT_LT(information(2, 2), rot_before);
    trans_before = information(0, 0);
    rot_before = information(2, 2);
  }
  const Eigen::Matrix3d ahead = motion_information({1.0, 0.0, 0.0}, noise);
  const Eigen::Matrix3d turned = motion_information({1.0, 0.0, 1.0}, noise);
  EXPECT_EQ(turned(0, 0), ahead(0, 0)) << "a turn does not move the robot";
  EXPECT_LT(turned(2, 2), ahead(2, 2));
}

TEST(MotionInformation, IsTheSameAheadAsideAndBack) {
  std::mt19937 random(4);
  for (int k = 0; k < 50; ++k) {
    const types::Se2 motion = testing::random_pose(random);
    const Eigen::Matrix3d one = motion_information(motion, {});
    EXPECT_EQ(one(0, 0), one(1, 1));
    EXPECT_EQ(one, Eigen::Matrix3d(one.diagonal().asDiagonal()));
    EXPECT_LT((motion_information(motion.inverse(), {}) - one).norm(), 1e-9 * one.norm());
    const types::Se2 elsewhere{motion.y_m, -motion.x_m, -motion.theta_rad};
    EXPECT_LT((motion_information(elsewhere, {}) - one).norm(), 1e-9 * one.norm());
  }
}

}  // namespace
}  // namespace topo::slam

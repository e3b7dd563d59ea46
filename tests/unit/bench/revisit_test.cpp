// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/revisit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/slam/make_keyframe.hpp"
#include "core/slam/map_builder.hpp"

namespace topo::bench {
namespace {

constexpr double kLength_m = 30.0,
                 kHalfWidth_m = 1.0;  ///< of a corridor along the x axis, closed at both ends

double range_in_corridor(const types::Se2& pose, double angle_rad) {
  const double dx = std::cos(pose.theta_rad + angle_rad), dy = std::sin(pose.theta_rad + angle_rad);
  const double to_end = dx > 0.0 ? (kLength_m - pose.x_m) / dx : -pose.x_m / dx;
  const double to_side = dy > 0.0 ? (kHalfWidth_m - pose.y_m) / dy : (-kHalfWidth_m - pose.y_m) / dy;
  return std::min(to_end, to_side);
}

slam::KeyframePtr seen_from(const types::Se2& pose) {
  slam::Cloud cloud;
  for (int k = -180; k <= 180; ++k) {
    const double angle = 0.5 * k * std::numbers::pi / 180.0 + 1e-4, range = range_in_corridor(pose, angle);
    cloud.points.emplace_back(static_cast<float>(range * std::cos(angle)),
                              static_cast<float>(range * std::sin(angle)));
    cloud.spacing_m.push_back(static_cast<float>(range * 0.5 * std::numbers::pi / 180.0));
  }
  return slam::make_keyframe({}, cloud, cloud.points, {}, {}, {});
}

/// Along the corridor and back; the way back drawn aside by that much.
RevisitShare there_and_back(double aside_m) {
  std::vector<slam::KeyframePtr> keyframes;
  std::vector<types::Se2> poses;
  for (int k = 0; k < 100; ++k) {
    const bool back = k >= 50;
    const types::Se2 truth{1.0 + 0.5 * (back ? 99 - k : k), 0.0, back ? std::numbers::pi : 0.0};
    keyframes.push_back(seen_from(truth));
    poses.push_back({truth.x_m, truth.y_m + (back ? aside_m : 0.0), truth.theta_rad});
  }
  slam::MapBuilder builder({});
  builder.update(keyframes, poses);
  return revisit_share(keyframes, poses, builder.grid());
}

TEST(RevisitShare, IsWholeWhereBothVisitsAgree) {
  const RevisitShare share = there_and_back(0.0);
  EXPECT_GT(share.points, 10000U);
  EXPECT_GT(share.share(), 0.99);
}

TEST(RevisitShare, IsSmallWhereTheWallsStandTwice) {
  const RevisitShare share = there_and_back(0.35);
  EXPECT_GT(share.points, 10000U);
  EXPECT_LT(share.share(), 0.3);
}

TEST(RevisitShare, HasNoPointsOnAWayThatNeverComesBack) {
  std::vector<slam::KeyframePtr> keyframes;
  std::vector<types::Se2> poses;
  for (int k = 0; k < 50; ++k) {
    poses.push_back({1.0 + 0.5 * k, 0.0, 0.0});
    keyframes.push_back(seen_from(poses.back()));
  }
  slam::MapBuilder builder({});
  builder.update(keyframes, poses);
  EXPECT_EQ(revisit_share(keyframes, poses, builder.grid()).points, 0U);
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/doubt/revisit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/slam/make_keyframe.hpp"
#include "core/slam/map_builder.hpp"

namespace topo::slam {
namespace {

constexpr double kLength_m = 30.0,
                 kHalfWidth_m = 1.0;  ///< of a corridor along the x axis, closed at both ends

double range_in_corridor(const types::Se2& pose, double angle_rad) {
  const double dx = std::cos(pose.theta_rad + angle_rad), dy = std::sin(pose.theta_rad + angle_rad);
  const double to_end = dx > 0.0 ? (kLength_m - pose.x_m) / dx : -pose.x_m / dx;
  const double to_side = dy > 0.0 ? (kHalfWidth_m - pose.y_m) / dy : (-kHalfWidth_m - pose.y_m) / dy;
  return std::min(to_end, to_side);
}

KeyframePtr seen_from(const types::Se2& pose, std::uint16_t robot = 0) {
  Cloud cloud;
  for (int k = -180; k <= 180; ++k) {
    const double angle = 0.5 * k * std::numbers::pi / 180.0 + 1e-4, range = range_in_corridor(pose, angle);
    cloud.points.emplace_back(static_cast<float>(range * std::cos(angle)),
                              static_cast<float>(range * std::sin(angle)));
    cloud.spacing_m.push_back(static_cast<float>(range * 0.5 * std::numbers::pi / 180.0));
  }
  return make_keyframe({robot}, cloud, cloud.points, {}, {}, {});
}

struct Map {
  void add(const types::Se2& truth, const types::Se2& drawn, std::uint16_t robot = 0) {
    keyframes.push_back(seen_from(truth, robot));
    poses.push_back(drawn);
  }
  [[nodiscard]] RevisitShare share() const {
    MapBuilder builder({});
    builder.update(keyframes, poses);
    return revisit_share(keyframes, poses, builder.grid());
  }
  std::vector<KeyframePtr> keyframes;
  std::vector<types::Se2> poses;
};

/// Along the corridor and back; the way back drawn aside by that much. `mate`: after each keyframe comes one
/// of another robot, which goes along another corridor and does not come back.
Map there_and_back_map(double aside_m, bool mate = false) {
  Map map;
  for (int k = 0; k < 100; ++k) {
    const bool back = k >= 50;
    const types::Se2 truth{1.0 + 0.5 * (back ? 99 - k : k), 0.0, back ? std::numbers::pi : 0.0};
    map.add(truth, {truth.x_m, truth.y_m + (back ? aside_m : 0.0), truth.theta_rad});
    const types::Se2 of_mate{1.0 + 0.25 * k, 0.0, 0.0};
    if (mate) map.add(of_mate, {of_mate.x_m, 50.0, 0.0}, 1);
  }
  return map;
}

RevisitShare there_and_back(double aside_m) { return there_and_back_map(aside_m).share(); }

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

TEST(RevisitShare, IsTheSumOverItsRegions) {
  const RevisitShare share = there_and_back(0.35);
  std::uint64_t points = 0, within = 0;
  for (const RevisitRegion& region : share.regions) {
    points += region.points;
    within += region.within;
    EXPECT_LE(region.within, region.points);
    EXPECT_NEAR(std::abs(region.centre.y()), 0.5 * RevisitRegion::kSide_m, 1e-9) << "the corridor is y < 2 m";
  }
  EXPECT_EQ(points, share.points);
  EXPECT_EQ(within, share.within);
  EXPECT_EQ(share.regions.size(), 10U)
      << "25 m on both sides of the x axis: at the end the way back is no other visit";
}

TEST(RevisitShare, HasNoPointsOnAWayThatNeverComesBack) {
  std::vector<KeyframePtr> keyframes;
  std::vector<types::Se2> poses;
  for (int k = 0; k < 50; ++k) {
    poses.push_back({1.0 + 0.5 * k, 0.0, 0.0});
    keyframes.push_back(seen_from(poses.back()));
  }
  MapBuilder builder({});
  builder.update(keyframes, poses);
  EXPECT_EQ(revisit_share(keyframes, poses, builder.grid()).points, 0U);
}

TEST(RevisitShare, TakesEachRobotsWayByItself) {
  const RevisitShare alone = there_and_back(0.35), team = there_and_back_map(0.35, true).share();
  EXPECT_EQ(team.points, alone.points) << "the mate comes nowhere again";
  EXPECT_EQ(team.within, alone.within);
}

}  // namespace
}  // namespace topo::slam

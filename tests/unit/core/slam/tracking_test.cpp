// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// A scan metres away from the last; mapper_test.cpp has those that follow closely.
#include "core/slam/tracking.hpp"

#include <gtest/gtest.h>

#include "core/slam/information.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// 60 m of corridor with a niche every 3 m on either side, all alike.
mocks::FlatWorld alike_corridor() {
  mocks::FlatWorld world;
  world.box(0.0, 0.0, 60.0, 2.4);
  for (double x = 1.5; x < 59.0; x += 3.0) {
    world.box(x, 0.0, x + 0.5, 0.3);
    world.box(x + 0.9, 2.1, x + 1.4, 2.4);
  }
  return world;
}

/// A scan that reaches `reach_m` to the front of `fov_rad`.
Cloud look(const mocks::FlatWorld& world, const Se2& pose, double fov_rad, double reach_m, double seconds,
           std::mt19937& random) {
  Cloud cloud;
  make_cloud(mocks::take_scan(world, pose, {}, {721, fov_rad, reach_m, 0.01}, random), {}, {}, {}, cloud);
  cloud.stamp = types::stamp_from_seconds(seconds);
  return cloud;
}

/// Of what a scan at `truth` says when odometry puts it at `predicted`, in a map of views from `seen`.
Tracked tracked(const mocks::FlatWorld& world, const std::vector<Se2>& seen, const Se2& truth,
                const Se2& last, const Se2& predicted, double reach_m) {
  const MapperParams params;
  std::mt19937 random(3);
  SurfelMap map(static_cast<float>(params.refine.reach_m));
  map.reset(last.translation().cast<float>(), params.keyframe.half_width_m);
  FreeGround ground(map.origin(), map.width_m(), params.free_ground);
  for (const Se2& pose : seen) {
    const Cloud cloud = look(world, pose, 1.5 * std::numbers::pi, reach_m, 1.0, random);
    map.add(make_surfels(cloud, params.cloud), pose);
    for (const Point& p : cloud.points)
      ground.add_ray(pose.translation().cast<float>(),
                     (pose * types::Vector2(p.cast<double>())).cast<float>());
  }
  std::vector<Point> points;
  select_points(look(world, truth, 1.5 * std::numbers::pi, reach_m, 1.0, random), params.cloud, points);
  const Prior prior{predicted, motion_information(last.inverse() * predicted, params.motion)};
  return track({map, [&] { return ground; }}, {points, Point::Zero()}, {{}, last, {}, {}, 0.0}, prior, prior,
               params);
}

TEST(Tracking, AfterALongWayALikenessNearerByIsNotTheRobotsPlace) {
  std::vector<Se2> seen;
  for (int i = 0; i <= 10; ++i) seen.emplace_back(5.0 + i, 1.2, 0.0);
  // 6.8 m on, nearly all that the scan shows is new; 3 m nearer by, where all is alike, half of it is not.
  const Se2 truth{21.8, 1.2, 0.0};
  const Tracked found = tracked(alike_corridor(), seen, truth, seen.back(), truth, 6.0);
  EXPECT_TRUE(found.searched);
  EXPECT_TRUE(!found.kept || std::abs(found.match.T_map_base.x_m - truth.x_m) < 0.3)
      << found.match.T_map_base.x_m;
}

TEST(Tracking, AScanThatSeesNothingIsLostWithoutASearch) {
  const std::vector<Se2> seen{{5.0, 1.2, 0.0}};
  const Tracked found = tracked(alike_corridor(), seen, {5.2, 1.2, 0.0}, seen.back(), {5.2, 1.2, 0.0}, 0.1);
  EXPECT_FALSE(found.kept);
  EXPECT_FALSE(found.searched);
}

}  // namespace
}  // namespace topo::slam

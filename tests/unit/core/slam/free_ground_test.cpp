// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/free_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

constexpr float kWall_m = 3.0F;  ///< where rays end

/// The square from -5 m to 5 m, with rays from the middle to x = 3 m, and what surfaces there are.
struct LookedThrough {
  explicit LookedThrough(int rays, std::vector<Surfel> surfels = {}) {
    map.reset(Point::Zero(), 5.0);
    map.add(surfels, {});
    for (int k = 0; k < rays; ++k) ground.add_ray(Point(0.05F, 0.05F), Point(kWall_m, 0.05F));
  }
  [[nodiscard]] double at(float x, float y) const {
    return ground.contradiction(map, std::vector<Point>{Point(x, y)}, {});
  }
  SurfelMap map{0.35};
  FreeGround ground{Point(-5.0F, -5.0F), 10.0, {}};
};

TEST(FreeGround, WhatStandsWhereRaysPassedContradicts) {
  const LookedThrough seen(3);
  for (const float x : {0.1F, 0.7F, 1.5F, 2.3F}) EXPECT_EQ(seen.at(x, 0.05F), 1.0) << x;
  EXPECT_EQ(seen.at(2.9F, 0.05F), 0.0) << "before its end a ray says nothing";
  EXPECT_EQ(seen.at(3.5F, 0.05F), 0.0) << "nor beyond";
  EXPECT_EQ(seen.at(-0.5F, 0.05F), 0.0) << "nor behind where it began";
  EXPECT_EQ(seen.at(1.5F, 0.5F), 0.0) << "nor beside it";
}

TEST(FreeGround, WhatEnoughRaysCrossedIsCrossed) {
  const LookedThrough seen(3), hardly(2);
  EXPECT_TRUE(seen.ground.is_crossed(Point(1.5F, 0.05F)));
  EXPECT_FALSE(hardly.ground.is_crossed(Point(1.5F, 0.05F)));
  EXPECT_FALSE(seen.ground.is_crossed(Point(1.5F, 0.5F))) << "beside the rays";
  EXPECT_FALSE(seen.ground.is_crossed(Point(kWall_m, 0.05F))) << "where they end stands a wall";
  EXPECT_FALSE(seen.ground.is_crossed(Point(50.0F, 0.05F))) << "outside";
}

TEST(FreeGround, AFewRaysMayBeNoiseAndManyAreNot) {
  for (const int rays : {0, 1, 2}) EXPECT_EQ(LookedThrough(rays).at(1.5F, 0.05F), 0.0) << rays;
  for (const int rays : {3, 10, 255, 256, 257, 600})
    EXPECT_EQ(LookedThrough(rays).at(1.5F, 0.05F), 1.0) << rays;
}

TEST(FreeGround, AsManyRaysAsTheParameterSaysAreEnough) {
  const SurfelMap map{0.35};
  for (const int rays_min : {1, 2, 5}) {
    FreeGroundParams params;
    params.rays_min = rays_min;
    FreeGround ground(Point(-5.0F, -5.0F), 10.0, params);
    for (int rays = 1; rays <= 6; ++rays) {
      ground.add_ray(Point(0.0F, 0.05F), Point(3.0F, 0.05F));
      const double share = ground.contradiction(map, std::vector<Point>{Point(1.5F, 0.05F)}, {});
      EXPECT_EQ(share, rays >= rays_min ? 1.0 : 0.0) << rays << " of " << rays_min;
    }
  }
}

TEST(FreeGround, ASurfaceThatIsNearExplainsAPoint) {
  const LookedThrough seen(5, {{Point(1.55F, 0.05F), Point(-1.0F, 0.0F), true}});
  EXPECT_EQ(seen.at(1.5F, 0.05F), 0.0);
  EXPECT_EQ(seen.at(1.7F, 0.05F), 0.0);
  EXPECT_EQ(seen.at(1.9F, 0.05F), 1.0) << "further than 0.2 m it is another thing";
  EXPECT_EQ(seen.at(1.2F, 0.05F), 1.0);
}

TEST(FreeGround, ARayOfNoLengthOrOutsideSaysNothing) {
  LookedThrough seen(0);
  for (int k = 0; k < 5; ++k) {
    seen.ground.add_ray(Point(1.0F, 1.0F), Point(1.0F, 1.0F));
    seen.ground.add_ray(Point(1.0F, 1.0F), Point(1.3F, 1.0F));
    seen.ground.add_ray(Point(-9.0F, 7.0F), Point(9.0F, 7.0F));
  }
  EXPECT_EQ(seen.at(1.0F, 1.0F), 0.0);
  EXPECT_EQ(seen.at(1.1F, 1.0F), 0.0);
  for (const float x : {-8.0F, 0.0F, 8.0F}) EXPECT_EQ(seen.at(x, 7.0F), 0.0);
  for (int k = 0; k < 5; ++k) seen.ground.add_ray(Point(-9.0F, 2.0F), Point(9.0F, 2.0F));
  EXPECT_EQ(seen.at(0.0F, 2.0F), 1.0) << "what of a ray lies in the window counts";
  EXPECT_EQ(seen.at(-8.0F, 2.0F), 0.0);
  EXPECT_EQ(seen.at(NAN, NAN), 0.0);
}

TEST(FreeGround, ContradictionIsTheShareOfThePoints) {
  const LookedThrough seen(4);
  EXPECT_EQ(seen.ground.contradiction(seen.map, {}, {}), 0.0);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> along(-1.0F, 4.0F);
  std::vector<Point> points;
  double count = 0.0;
  for (int k = 0; k < 40; ++k) {
    points.emplace_back(along(random), k % 3 == 0 ? 1.0F : 0.05F);
    count += seen.at(points.back().x(), points.back().y());
    EXPECT_NEAR(seen.ground.contradiction(seen.map, points, {}), count / (k + 1.0), 1e-12);
  }
  EXPECT_GT(count, 5.0);
}

TEST(FreeGround, PointsStandWhereThePosePutsThem) {
  const LookedThrough seen(4);
  const std::vector<Point> ahead{Point(1.0F, 0.0F)};
  const auto at = [&](const types::Se2& pose) { return seen.ground.contradiction(seen.map, ahead, pose); };
  EXPECT_EQ(at({0.5, 0.05, 0.0}), 1.0);
  EXPECT_EQ(at({0.5, 0.05, std::numbers::pi / 2.0}), 0.0) << "it looks aside";
  EXPECT_EQ(at({1.5, -0.95, std::numbers::pi / 2.0}), 1.0);
  EXPECT_EQ(at({2.5, 0.05, std::numbers::pi}), 1.0);
}

TEST(SeenThrough, IsTheRoomAndNotWhatLiesBehindItsWalls) {
  mocks::FlatWorld room;
  room.box(-2.0, -2.0, 2.0, 2.0);
  std::mt19937 random(2);
  std::vector<KeyframePtr> keyframes;
  const std::vector<types::Se2> poses{{0.5, 0.5, 0.0}, {-0.5, 0.0, 2.0}, {0.0, -0.5, -2.0}};
  SurfelMap map(0.35);
  map.reset(Point::Zero(), 5.0);
  for (const types::Se2& pose : poses) {
    const testing::View view = testing::view_of(room, pose, 0.0, random);
    auto keyframe = std::make_shared<Keyframe>();
    keyframe->content = CodedContent({{}, {}, view.points, {}});
    keyframe->sensor = view.cloud.sensor;
    keyframes.push_back(std::move(keyframe));
    map.add(view.surfels, pose);
  }
  const FreeGround ground = seen_through(keyframes, poses, map, {});
  const auto share = [&](float from, float to) {
    std::vector<Point> points;
    for (float x = -to; x <= to; x += 0.1F) {
      for (float y = -to; y <= to; y += 0.1F)
        if (std::max(std::abs(x), std::abs(y)) >= from) points.emplace_back(x, y);
    }
    return ground.contradiction(map, points, {});
  };
  EXPECT_GT(share(0.0F, 1.2F), 0.95) << "the middle was looked through from three places";
  EXPECT_EQ(share(1.85F, 2.1F), 0.0) << "the walls are where they are";
  EXPECT_EQ(share(2.2F, 4.5F), 0.0) << "nobody has seen what is outside";
  EXPECT_EQ(seen_through({}, {}, map, {}).contradiction(map, std::vector<Point>{Point::Zero()}, {}), 0.0);
}

}  // namespace
}  // namespace topo::slam

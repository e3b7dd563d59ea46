// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/team_alignment.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/slam/keyframe_sample.hpp"
#include "tests/unit/core/slam/team_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

Session map_of_way(const mocks::FlatWorld& world, const std::vector<Se2>& way, std::uint16_t robot) {
  std::mt19937 random(robot + 1U);
  Mapper mapper({}, {robot, 0});
  testing::drive(mapper, world, way, random);
  return mapper.session();
}

/// 60 m of corridor; with `niches` one every 3 m on either side, all alike.
mocks::FlatWorld corridor(bool niches) {
  mocks::FlatWorld world;
  world.box(0.0, 0.0, 60.0, 2.4);
  for (double x = 1.5; niches && x < 59.0; x += 3.0) {
    world.box(x, 0.0, x + 0.5, 0.3);
    world.box(x + 0.9, 2.1, x + 1.4, 2.4);
  }
  return world;
}

TEST(AlignMaps, findsTheMapOfATeamMateThatWentTheOtherWayRound) {
  const mocks::FlatWorld world = mocks::ring_corridor();
  const auto own_way = testing::legs({{1.2, 1.2}, {22.8, 1.2}, {22.8, 16.8}, {5.0, 16.8}});
  const auto mates_way = testing::legs({{22.8, 12.0}, {22.8, 1.2}, {3.0, 1.2}});
  const AlignmentQuery query{map_of_way(world, own_way, 0), map_of_way(world, mates_way, 1), {}};
  const Alignment found = align_maps(query);
  ASSERT_TRUE(found.found()) << describe(found);
  const Se2 truth = own_way.front().inverse() * mates_way.front();
  EXPECT_LT((found.T_own_mates.translation() - truth.translation()).norm(), 0.4) << describe(found);
  EXPECT_LT(std::abs(types::wrap_angle(found.T_own_mates.theta_rad - truth.theta_rad)), 0.03);
  ASSERT_GE(found.closures.size(), 4U);
  for (const auto& [key, relation] : found.closures) {
    EXPECT_EQ(key.first.robot, 0);
    EXPECT_EQ(key.second.robot, 1);
    EXPECT_TRUE(relation.robust);
    EXPECT_TRUE(check_relation({{0, 0}, key, relation}));
  }
}

TEST(AlignMaps, refusesABareCorridor) {
  const mocks::FlatWorld world = corridor(false);
  const AlignmentQuery query{map_of_way(world, testing::legs({{2.0, 1.2}, {58.0, 1.2}}), 0),
                             map_of_way(world, testing::legs({{12.0, 1.2}, {48.0, 1.2}}), 1),
                             {}};
  const Alignment found = align_maps(query);
  EXPECT_FALSE(found.found()) << describe(found);
}

TEST(AlignMaps, refusesACorridorThatLooksTheSameEveryThreeMetres) {
  const mocks::FlatWorld world = corridor(true);
  AlignmentQuery query{map_of_way(world, testing::legs({{2.0, 1.2}, {58.0, 1.2}}), 0),
                       map_of_way(world, testing::legs({{18.0, 1.2}, {42.0, 1.2}}), 1),
                       {}};
  for (Session* session : {&query.own, &query.mates}) {
    for (KeyframePtr& keyframe : session->keyframes) {  // eyes that do not reach the corridor's ends
      Keyframe near = *keyframe;
      KeyframeContent content = testing::decoded(keyframe->content);
      std::erase_if(content.match_points, [](const Point& p) { return p.norm() > 8.0F; });
      std::erase_if(content.surfels, [](const Surfel& s) { return s.position.norm() > 8.0F; });
      near.content = CodedContent(std::move(content));
      keyframe = std::make_shared<const Keyframe>(std::move(near));
    }
  }
  const Alignment found = align_maps(query);
  EXPECT_FALSE(found.found()) << describe(found);
}

TEST(AlignMaps, refusesAnotherBuilding) {
  const AlignmentQuery query{
      map_of_way(mocks::ring_corridor(), testing::legs({{1.2, 1.2}, {22.8, 1.2}, {22.8, 16.8}, {5.0, 16.8}}),
                 0),
      map_of_way(mocks::two_rooms(),
                 testing::legs({{1.5, 1.5}, {5.0, 1.5}, {5.0, 3.6}, {9.0, 3.6}, {9.0, 6.0}}), 1),
      {}};
  const Alignment found = align_maps(query);
  EXPECT_FALSE(found.found()) << describe(found);
}

TEST(AlignMaps, withoutAMapNothingIsFound) {
  EXPECT_EQ(align_maps({}).refusal, AlignmentRefusal::kNoMap);
  EXPECT_FALSE(describe(align_maps({})).empty());
}

}  // namespace
}  // namespace topo::slam

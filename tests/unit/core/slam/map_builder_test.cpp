// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/map_builder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "tests/unit/core/slam/map_contents.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using testing::columns;
using testing::states;
using types::Se2;

KeyframePtr keyframe_at(const Se2& pose, std::uint32_t sequence, std::mt19937& random) {
  const testing::View view = testing::view_of(mocks::two_rooms(), pose, 0.01, random);
  auto keyframe = std::make_shared<Keyframe>();
  keyframe->id.sequence = sequence;
  keyframe->content = CodedContent({view.cloud.points, {}, {}, {{1.0F, 0.5F, 7U << sequence}}});
  return keyframe;
}

TEST(MapBuilder, IsAFunctionOfTheKeyframesAndTheirPoses) {
  std::mt19937 random(1);
  const std::vector<Se2> truth{{2.0, 2.0, 0.0}, {3.5, 2.5, 0.5}, {5.0, 3.5, -0.5}, {8.5, 3.6, 0.1}};
  std::vector<KeyframePtr> keyframes;
  for (std::uint32_t i = 0; i < truth.size(); ++i) keyframes.push_back(keyframe_at(truth[i], i, random));
  MapBuilder direct({});
  direct.update(keyframes, truth);
  EXPECT_TRUE(rc::check("growing, wandering and coming back gives the same map", [&] {
    MapBuilder wandering({});
    const auto off = [](int range) { return *rc::gen::inRange(-range, range) / 100.0; };
    for (std::size_t n = 1; n <= truth.size(); ++n) {
      std::vector<Se2> poses(truth.begin(), truth.begin() + static_cast<std::ptrdiff_t>(n));
      for (Se2& pose : poses) pose = pose * Se2{off(60), off(60), off(20)};
      wandering.update({keyframes.data(), n}, poses);
    }
    // The last ones by less than what is redrawn while the robot drives.
    std::vector<Se2> nearly = truth;
    for (Se2& pose : nearly) pose = pose * Se2{0.1 * off(10), 0.1 * off(10), 0.01 * off(10)};
    wandering.update(keyframes, nearly);
    wandering.update(keyframes, truth);
    RC_ASSERT(states(wandering.grid()) == states(direct.grid()));
    RC_ASSERT(columns(wandering.walls()) == columns(direct.walls()));
  }));
}

TEST(MapBuilder, TheMapAtOtherPosesIsMadeBesideTheOneThatIsShown) {
  EXPECT_TRUE(rc::check("a piece at a time, whatever comes in between", [] {
    std::mt19937 random(3);
    std::vector<Se2> poses{{2.0, 2.0, 0.0}, {3.5, 2.5, 0.5}, {5.0, 3.5, -0.5}, {8.5, 3.6, 0.1}};
    std::vector<KeyframePtr> keyframes;
    for (std::uint32_t i = 0; i < poses.size(); ++i) keyframes.push_back(keyframe_at(poses[i], i, random));
    const auto begin = static_cast<std::size_t>(*rc::gen::inRange(0, 4));
    MapBuilder builder({});
    builder.extend({keyframes.data(), begin}, poses);
    std::vector<Se2> elsewhere = poses;
    for (Se2& pose : elsewhere) pose = Se2{0.3, 0.1, 0.02} * pose;
    std::size_t pieces = 1;
    while (!builder.prepare({keyframes.data(), begin}, elsewhere, 1)) ++pieces;
    RC_ASSERT(pieces == std::max<std::size_t>(begin, 1));
    builder.extend(keyframes, poses);
    MapBuilder at_poses({}), at_elsewhere({});
    at_poses.update(keyframes, poses);
    at_elsewhere.update(keyframes, elsewhere);
    RC_ASSERT(states(builder.grid()) == states(at_poses.grid()));
    RC_ASSERT(columns(builder.walls()) == columns(at_poses.walls()));
    while (!builder.prepare(keyframes, elsewhere, 1)) {
    }
    builder.show();
    RC_ASSERT(states(builder.grid()) == states(at_elsewhere.grid()));
    RC_ASSERT(columns(builder.walls()) == columns(at_elsewhere.walls()));
    builder.update(keyframes, poses);
    RC_ASSERT(states(builder.grid()) == states(at_poses.grid()));
    RC_ASSERT(columns(builder.walls()) == columns(at_poses.walls()));
  }));
}

TEST(MapBuilder, WhatWasShownALittleOffIsDrawnToTheCellByAndBy) {
  std::mt19937 random(4);
  std::vector<Se2> poses{{2.0, 2.0, 0.0}, {3.5, 2.5, 0.5}, {5.0, 3.5, -0.5}, {8.5, 3.6, 0.1}};
  std::vector<KeyframePtr> keyframes;
  for (std::uint32_t i = 0; i < poses.size(); ++i) keyframes.push_back(keyframe_at(poses[i], i, random));
  MapBuilder builder({}), exact({});
  builder.extend(keyframes, poses);
  for (Se2& pose : poses) pose = Se2{0.012, -0.011, 0.001} * pose;  // less than is drawn again at once
  exact.update(keyframes, poses);
  ASSERT_TRUE(builder.prepare(keyframes, poses, 1));
  EXPECT_FALSE(builder.settle(keyframes, poses, 1)) << "another map is in preparation";
  builder.show();
  ASSERT_NE(states(builder.grid()), states(exact.grid()));
  std::size_t pieces = 1;
  while (!builder.settle(keyframes, poses, 1)) ++pieces;
  EXPECT_EQ(pieces, poses.size());
  EXPECT_EQ(states(builder.grid()), states(exact.grid()));
  EXPECT_EQ(columns(builder.walls()), columns(exact.walls()));
  // Back again: whatever is taken back is what was drawn.
  for (Se2& pose : poses) pose = Se2{-0.3, 0.2, 0.0} * pose;
  exact.update(keyframes, poses);
  while (!builder.prepare(keyframes, poses, 1)) {
  }
  builder.show();
  EXPECT_TRUE(builder.settle(keyframes, poses, 1));
  EXPECT_EQ(states(builder.grid()), states(exact.grid()));
}

TEST(MapBuilder, WallsFollowTheirKeyframe) {
  std::mt19937 random(2);
  const std::vector<KeyframePtr> keyframes{keyframe_at({2.0, 2.0, 0.0}, 0, random)};
  MapBuilder builder({});
  builder.update(keyframes, std::vector<Se2>{{2.0, 2.0, 0.0}});
  const auto before = columns(builder.walls());
  builder.update(keyframes, std::vector<Se2>{{4.0, 2.0, 0.0}});
  const auto after = columns(builder.walls());
  ASSERT_EQ(before.size(), 1U);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(patricia::cell_of(after.begin()->first).x - patricia::cell_of(before.begin()->first).x, 40);
  EXPECT_EQ(after.begin()->second, before.begin()->second);
}

}  // namespace
}  // namespace topo::slam

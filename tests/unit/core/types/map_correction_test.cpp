// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/map_correction.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace topo::types {
namespace {

/// Keyframes along a corridor, one a metre.
std::vector<KeyframePose> corridor(std::size_t count) {
  std::vector<KeyframePose> keyframes;
  for (std::size_t i = 0; i < count; ++i)
    keyframes.push_back({stamp_from_seconds(static_cast<double>(i)),
                         Transform2<Map, Base>(static_cast<double>(i), 0.0, 0.0)});
  return keyframes;
}

std::vector<KeyframePose> moved(std::vector<KeyframePose> keyframes, const Se2& change) {
  for (KeyframePose& keyframe : keyframes) {
    const Se2 now = change * keyframe.T_map_base.se2();
    keyframe.T_map_base = {now.x_m, now.y_m, now.theta_rad};
  }
  return keyframes;
}

TEST(MapCorrection, OfAMapThatMovesAsAWholeMovesEveryPointWithIt) {
  EXPECT_TRUE(rc::check([] {
    const auto number = [](int range) { return *rc::gen::inRange(-range, range) / 100.0; };
    const Se2 change{number(500) + 6.0, number(500), number(300)};
    MapAnchors anchors;
    const auto before = corridor(*rc::gen::inRange<std::size_t>(1, 9));
    RC_ASSERT(!anchors.take(before, 0.1, 0.03));
    const auto correction = anchors.take(moved(before, change), 0.1, 0.03);
    RC_ASSERT(correction.has_value());
    const Vector2 p(number(2000), number(2000));
    RC_ASSERT(((*correction)(p)-change * p).norm() < 1e-9);
    std::vector<Vector2> points{p, p};
    correction->move(points);
    RC_ASSERT(points[1] == (*correction)(p));
    RC_ASSERT(!anchors.take(moved(before, change), 0.1, 0.03));  // once
  }));
}

TEST(MapCorrection, MovesAPointWithTheKeyframeThatWasNearestToIt) {
  MapAnchors anchors;
  (void)anchors.take(corridor(5), 0.1, 0.03);
  auto bent = corridor(6);
  bent[4].T_map_base = {4.0, 1.0, 0.0};  // a loop closure moves the far end
  const auto correction = anchors.take(bent, 0.1, 0.03);
  ASSERT_TRUE(correction);
  EXPECT_LT(((*correction)({0.2, 2.0}) - Vector2(0.2, 2.0)).norm(), 1e-12);
  EXPECT_LT(((*correction)({4.1, 2.0}) - Vector2(4.1, 3.0)).norm(), 1e-12);
}

TEST(MapAnchors, AreThoseOfTheLastCorrectionAndNotOfTheLastMap) {
  MapAnchors anchors;
  const auto keyframes = corridor(4);
  (void)anchors.take(keyframes, 0.1, 0.03);
  std::optional<MapCorrection> correction;
  int steps = 0;
  while (!correction && ++steps < 10)
    correction = anchors.take(moved(keyframes, {0.03 * steps, 0.0, 0.0}), 0.1, 0.03);
  EXPECT_EQ(steps, 4) << "small corrections add up";
  ASSERT_TRUE(correction);
  EXPECT_LT(((*correction)({1.0, 1.0}) - Vector2(1.12, 1.0)).norm(), 1e-9);
}

TEST(MapAnchors, OfAnotherMapCorrectNothing) {
  MapAnchors anchors;
  EXPECT_FALSE(anchors.take({}, 0.1, 0.03));
  EXPECT_FALSE(anchors.take(corridor(4), 0.1, 0.03));
  auto other = moved(corridor(4), {9.0, 0.0, 0.0});
  for (KeyframePose& keyframe : other) keyframe.stamp += std::chrono::hours(1);
  EXPECT_FALSE(anchors.take(other, 0.1, 0.03)) << "begun anew";
  EXPECT_FALSE(anchors.take(moved(corridor(2), {5.0, 0.0, 0.0}), 0.1, 0.03)) << "fewer than before";
  EXPECT_TRUE(anchors.take(corridor(2), 0.1, 0.03));
}

}  // namespace
}  // namespace topo::types

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/seen_ground.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::perception {
namespace {

using motion::empty_scan;

using types::Se2;

constexpr double kFar_m = 0.15;
const Se2 kLaser{0.021, 0.0, 0.0};
const types::Footprint kOutline;

struct Looker {
  SeenGround ground;
  types::Stamp now = types::stamp_from_seconds(100.0);

  void look_from(const Se2& pose, float range_m = types::kNoReturn) {
    now += std::chrono::milliseconds(50);
    const auto scan = empty_scan(now);
    scan->range_m.fill(range_m);
    ground.update(*scan, kLaser, pose, kOutline, {});
  }
  [[nodiscard]] double behind_m(const Se2& pose, types::Duration ago = std::chrono::minutes(1)) const {
    return ground.behind_m(pose, kOutline, now - ago, kFar_m);
  }
};

Se2 anywhere() {
  const auto metres = [] { return 0.01 * *rc::gen::inRange(-10000, 10000); };
  return {metres(), metres(), 0.01 * *rc::gen::inRange(-314, 315)};
}

TEST(SeenGround, BehindARobotThatHasJustBegunNothingWasSeen) {
  EXPECT_TRUE(rc::check([] {
    Looker looker;
    const Se2 pose = anywhere();
    looker.look_from(pose);
    RC_ASSERT(looker.behind_m(pose) < 0.03);
  }));
}

TEST(SeenGround, KnowsTheGroundBehindAfterTurnsAndStraights) {
  EXPECT_TRUE(rc::check([](bool came) {
    Looker looker;
    const Se2 start = anywhere();
    Se2 pose = start;
    for (int i = 0; i < 40; ++i) looker.look_from(pose = pose * (came ? Se2{0.02, 0, 0} : Se2{0, 0, 0.1}));
    pose.theta_rad = types::wrap_angle(pose.theta_rad + 0.01 * *rc::gen::inRange(-314, 315));
    looker.look_from(pose);
    RC_ASSERT(looker.behind_m(pose) == kFar_m);
  }));
}

TEST(SeenGround, WhatABeamDoesNotReachIsNotSeen) {
  Looker looker;
  for (int i = 0; i < 63; ++i) looker.look_from({0, 0, 0.1 * i}, 0.35F);  // a shaft round the laser
  const double behind_m = looker.behind_m({0, 0, 0});
  EXPECT_LT(behind_m, 0.35 + 0.021 - kOutline.rear_m + 0.03);
  for (const float range_m : {types::kInvalid, types::kTooNear}) {
    Looker blind;
    for (int i = 0; i < 63; ++i) blind.look_from({0, 0, 0.1 * i}, range_m);
    EXPECT_LT(blind.behind_m({0, 0, 0}), 0.03);
  }
}

TEST(SeenGround, WhatWasSeenBeforeDoesNotCount) {
  Looker looker;
  for (int i = 0; i < 63; ++i) looker.look_from({0, 0, 0.1 * i});
  EXPECT_EQ(looker.behind_m({0, 0, 0}), kFar_m);
  looker.now += std::chrono::seconds(59);
  EXPECT_EQ(looker.behind_m({0, 0, 0}), kFar_m);
  looker.now += std::chrono::seconds(2);
  EXPECT_LT(looker.behind_m({0, 0, 0}), 0.03);
  EXPECT_EQ(looker.behind_m({0, 0, 0}, std::chrono::minutes(2)), kFar_m);
  looker.ground.clear();
  EXPECT_EQ(looker.behind_m({0, 0, 0}, std::chrono::minutes(2)), 0.0);
}

/// A square of cells that goes along takes what is a side's length away for itself.
TEST(SeenGround, ElsewhereNothingWasSeen) {
  EXPECT_TRUE(rc::check([] {
    Looker looker;
    for (int i = 0; i < 63; ++i) looker.look_from({0, 0, 0.1 * i});
    const Se2 there = anywhere();
    RC_PRE(there.translation().norm() > 1.3);
    RC_ASSERT(looker.behind_m(there) == 0.0);
  }));
  Looker looker;
  for (int i = 0; i < 63; ++i) looker.look_from({0, 0, 0.1 * i});
  for (const double side_m : {-2.56, 2.56})
    EXPECT_EQ(looker.behind_m({side_m, 0, 0}), 0.0) << "the same cells";
}

}  // namespace
}  // namespace topo::perception

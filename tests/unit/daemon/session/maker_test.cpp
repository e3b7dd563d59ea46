// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/maker.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/daemon/session/session_sample.hpp"

namespace topo::daemon {
namespace {

slam::Session signed_by(const slam::Maker& maker) {
  slam::Session session = testing::sample_session(3, 1);
  for (slam::KeyframePtr& keyframe : session.keyframes) {
    slam::Keyframe k = *keyframe;
    k.id = {maker.robot, k.id.sequence, maker.run};
    keyframe = std::make_shared<const slam::Keyframe>(std::move(k));
  }
  return session;
}

TEST(Maker, EveryRunIsAnother) {
  std::set<slam::Maker> makers;
  for (int i = 0; i < 10; ++i) makers.insert(new_maker(7));
  EXPECT_EQ(makers.size(), 10U);
  for (const slam::Maker& maker : makers) {
    EXPECT_EQ(maker.robot, 7);
    EXPECT_NE(maker.run, 0U) << "the run of sessions without one";
  }
}

TEST(Maker, WhatNobodySignedIsTheRobots) {
  const slam::Session old = signed_by({0, 0});
  const slam::Session own = claimed(old, 7);
  EXPECT_TRUE(testing::same(own, signed_by({7, 0})));
  EXPECT_EQ(old.keyframes[0]->id.robot, 0) << "keyframes are shared and stay as they are";
}

TEST(Maker, WhatSomebodySignedStaysHis) {
  const slam::Session mates = signed_by({3, 21});
  EXPECT_TRUE(testing::same(claimed(mates, 7), mates));
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/origin.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/daemon/session/session_sample.hpp"

namespace topo::daemon {
namespace {

slam::Session signed_by(const slam::Origin& origin) {
  slam::Session session = testing::sample_session(3, 1);
  for (slam::KeyframePtr& keyframe : session.keyframes) {
    slam::Keyframe k = *keyframe;
    k.id = {origin.robot, k.id.sequence, origin.run};
    keyframe = std::make_shared<const slam::Keyframe>(std::move(k));
  }
  return session;
}

TEST(Origin, EveryRunIsAnother) {
  std::set<slam::Origin> origins;
  for (int i = 0; i < 10; ++i) origins.insert(new_maker(7));
  EXPECT_EQ(origins.size(), 10U);
  for (const slam::Origin& origin : origins) {
    EXPECT_EQ(origin.robot, 7);
    EXPECT_NE(origin.run, 0U) << "the run of sessions without one";
  }
}

TEST(Origin, WhatNobodySignedIsTheRobots) {
  const slam::Session old = signed_by({0, 0});
  const slam::Session own = claimed(old, 7);
  EXPECT_TRUE(testing::same(own, signed_by({7, 0})));
  EXPECT_EQ(old.keyframes[0]->id.robot, 0) << "keyframes are shared and stay as they are";
}

TEST(Origin, WhatSomebodySignedStaysHis) {
  const slam::Session mates = signed_by({3, 21});
  EXPECT_TRUE(testing::same(claimed(mates, 7), mates));
}

}  // namespace
}  // namespace topo::daemon

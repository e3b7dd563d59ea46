// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/perceive.hpp"

#include <gtest/gtest.h>

#include <array>

namespace topo::pipeline {
namespace {

using types::Vector2;

/// Some periods in which sonar reports the same echo, while a team-mate is known to be at some places.
exploration::Intent after_echoes(const Vector2& echo, std::span<const Vector2> going_at, int periods,
                                 exploration::Intent intent) {
  ControlReport control;
  control.unseen = 1;
  control.unseen_odom[0] = echo;
  PlanningInput in;
  in.now = types::stamp_from_seconds(100.0);
  in.control = &control;
  for (int i = 0; i < periods; ++i) intent = felt(std::move(intent), in, {}, going_at, false, {});
  return intent;
}

constexpr int kEnough = 3;

TEST(Felt, AnEchoIsAnObstacle) {
  EXPECT_EQ(after_echoes({1.0, 2.0}, {}, kEnough, exploration::Intent()).obstacles.echoed().size(), 1U);
}

TEST(Felt, ATeamMateIsNone) {
  const std::array mate{Vector2(1.0, 2.2)};
  EXPECT_TRUE(after_echoes({1.0, 2.0}, mate, kEnough, exploration::Intent()).obstacles.echoed().empty());
}

TEST(Felt, AnEchoOfAMateFromBeforeItWasHeardIsForgotten) {
  const std::array mate{Vector2(1.0, 2.2)};
  exploration::Intent intent = after_echoes({1.0, 2.0}, {}, kEnough, exploration::Intent());
  intent = after_echoes({5.0, 5.0}, mate, 1, std::move(intent));
  EXPECT_TRUE(intent.obstacles.echoed().empty());
}

}  // namespace
}  // namespace topo::pipeline

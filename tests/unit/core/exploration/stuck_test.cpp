// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/stuck.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/exploration/toy_decision.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

class Stuck : public ToyDecision {
 protected:
  Intent fresh_;
};

TEST_F(Stuck, WhatStandsAheadIsAnObstacle) {
  Situation now = situation();
  for (const double heading_rad : {0.0, 1.0, -2.0}) {
    now.T_map_base.theta_rad = heading_rad;
    const Intent intent = block_ahead(now, map_, params_.pursuit, fresh_);
    const std::vector<Vector2> points = intent.obstacles.stuck_on();
    ASSERT_FALSE(points.empty());
    Vector2 sum(0.0, 0.0);
    for (const Vector2& p : points) sum += p;
    const Vector2 ahead = here() + 0.45 * Vector2(std::cos(heading_rad), std::sin(heading_rad));
    EXPECT_NEAR((sum / static_cast<double>(points.size()) - ahead).norm(), 0.0, 1e-9);
    EXPECT_TRUE(intent.is_outdated) << "the next route leads round it";
  }
}

TEST_F(Stuck, AMateAheadThatGoesOnIsNone) {
  Situation now = situation();
  const std::vector<Vector2> going{here() + Vector2(1.2, 0.0)};
  now.team.going_at = going;
  const Intent intent = block_ahead(now, map_, params_.pursuit, fresh_);
  EXPECT_TRUE(intent.obstacles.stuck_on().empty());
  EXPECT_FALSE(intent.is_outdated);
  now.T_map_base.theta_rad = 3.0;
  EXPECT_FALSE(block_ahead(now, map_, params_.pursuit, fresh_).obstacles.stuck_on().empty())
      << "it is behind";
}

TEST_F(Stuck, APlaceIsAimedAtByTheCellBesideIt) {
  const Vector2 place = here() + Vector2(2.0, 0.1);
  const Pursuit pursuit = aimed_at(place, map_, Pursuit{});
  ASSERT_TRUE(pursuit.has_target);
  EXPECT_LT((map_.map().centre_of(pursuit.target) - place).norm(), 0.1);
}

TEST_F(Stuck, APlaceOutOfReachIsNotAimedAt) {
  Pursuit pursuit;
  pursuit.goal.emplace();
  pursuit.target = {3, 4};
  pursuit.has_target = true;
  const Pursuit after = aimed_at({100.0, 100.0}, map_, pursuit);
  EXPECT_FALSE(after.has_target);
  EXPECT_EQ(after.target, pursuit.target);
}

}  // namespace
}  // namespace topo::exploration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/mission_way.hpp"

#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

TEST(MissionWay, IsTheSumOfItsSteps) {
  MissionWay way;
  way.note({5.0, 5.0}, true, true);
  way.note({5.6, 5.4}, true, true);
  EXPECT_DOUBLE_EQ(way.distance_m(), 0.0) << "more than half a metre is a jump";
  way.note({5.6, 5.5}, true, true);
  way.note({5.4, 5.5}, true, true);
  EXPECT_NEAR(way.distance_m(), 0.3, 1e-12);
  way.begin();
  EXPECT_DOUBLE_EQ(way.distance_m(), 0.0);
}

TEST(MissionWay, CountsNothingBetweenMissions) {
  MissionWay way;
  way.note({0.0, 0.0}, true, false);
  way.note({0.1, 0.0}, true, false);
  EXPECT_DOUBLE_EQ(way.distance_m(), 0.0);
  way.note({0.2, 0.0}, true, true);
  EXPECT_NEAR(way.distance_m(), 0.1, 1e-12) << "from where it stood";
}

TEST(MissionWay, CountsNothingFromWhereNoBaseWas) {
  MissionWay way;
  way.note({0.0, 0.0}, false, true);
  way.note({0.2, 0.0}, true, true);
  EXPECT_DOUBLE_EQ(way.distance_m(), 0.0);
  way.note({0.3, 0.0}, true, true);
  EXPECT_NEAR(way.distance_m(), 0.1, 1e-12);
}

}  // namespace
}  // namespace topo::daemon

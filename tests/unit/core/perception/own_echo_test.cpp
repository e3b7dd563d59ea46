// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/own_echo.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/perception/stop_zone.hpp"

namespace topo::perception {
namespace {

using std::chrono::milliseconds;

/// A scanner at the centre, a degree a beam, walls at 4 m.
struct Own : testing::Test {
  Own() {
    scan->geometry = {-2.35619F, static_cast<float>(types::kDegree_rad), 0.0F, 0.025F, 0.02F, 30.0F};
    scan->beams = 271;
    scan->range_m.fill(4.0F);
  }
  void look(types::Duration time) {
    for (const types::Stamp end = now + time; now < end;) {
      now += milliseconds(25);
      scan->arrival = now;
      own.update(*scan, T_base_laser, footprint);
    }
  }
  void put(int from_deg, int to_deg, float range_m) {
    for (int d = from_deg; d <= to_deg; ++d) scan->range_m[static_cast<std::size_t>(d + 135)] = range_m;
  }
  std::unique_ptr<types::Scan> scan = std::make_unique<types::Scan>();
  types::Se2 T_base_laser;
  types::Footprint footprint;
  types::Stamp now{std::chrono::seconds(10)};
  OwnEcho own;
};

TEST_F(Own, APostIsNamedByItsBearing) {
  put(38, 42, 0.15F);
  look(milliseconds(4500));
  EXPECT_FALSE(own.sector());
  look(milliseconds(1000));
  ASSERT_TRUE(own.sector());
  EXPECT_NEAR(own.sector()->from_rad / types::kDegree_rad, 38.0, 1.1);
  EXPECT_NEAR(own.sector()->to_rad / types::kDegree_rad, 42.0, 1.1);
}

TEST_F(Own, TheMountIsTurnedOut) {
  T_base_laser.theta_rad = 30.0 * types::kDegree_rad;
  put(10, 12, 0.15F);
  look(milliseconds(6000));
  ASSERT_TRUE(own.sector());
  EXPECT_NEAR(own.sector()->from_rad / types::kDegree_rad, 40.0, 1.1);
}

TEST_F(Own, WhatMovesOrIsOutsideIsNotTheRobot) {
  put(38, 42, 0.5F);
  look(milliseconds(6000));
  EXPECT_FALSE(own.sector());
  for (int i = 0; i < 20; ++i) {
    put(38, 42, i % 2 == 0 ? 0.12F : 0.18F);
    look(milliseconds(500));
  }
  EXPECT_FALSE(own.sector());
}

TEST_F(Own, AMaskedPostIsNoLongerSeen) {
  put(38, 42, 0.15F);
  look(milliseconds(6000));
  put(38, 42, types::kInvalid);
  look(milliseconds(100));
  EXPECT_FALSE(own.sector());
}

/// A post of five degrees in the sector that braking needs: unmasked it blocks, masked its gap is bridged.
TEST_F(Own, AMaskedGapDoesNotBlockAndAnUnmaskedOneDoes) {
  StopZoneParams params;
  types::RobotLimits limits;
  const types::Twist2 ahead{0.3, 0.0};
  Surroundings around{.front_scan = scan.get(),
                      .T_base_laser = T_base_laser,
                      .points = {},
                      .sonar = {},
                      .T_base_sonar = {},
                      .now = now,
                      .backing_off = false,
                      .params = params};
  const double open_s = free_time_s(ahead, limits, around);
  put(38, 42, types::kInvalid);
  EXPECT_EQ(free_time_s(ahead, limits, around), 0.0);
  around.params.masks.all[around.params.masks.count++] = {37.5 * types::kDegree_rad,
                                                          42.5 * types::kDegree_rad};
  EXPECT_DOUBLE_EQ(free_time_s(ahead, limits, around), open_s);
  put(43, 47, types::kInvalid);
  EXPECT_EQ(free_time_s(ahead, limits, around), 0.0) << "beams that fail beside the mask count";
  put(43, 47, 4.0F);
  put(36, 37, 0.25F);
  EXPECT_LT(free_time_s(ahead, limits, around), open_s) << "what reaches out of the mask is an obstacle";
}

}  // namespace
}  // namespace topo::perception

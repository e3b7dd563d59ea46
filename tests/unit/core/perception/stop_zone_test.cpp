// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/stop_zone.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/perception/footprint_sweep.hpp"
#include "tests/unit/core/motion/surroundings.hpp"

namespace topo::perception {
namespace {

using motion::empty_scan;
using motion::kAhead;
using motion::put_wall_ahead;

using types::Stamp;

constexpr Stamp kNow{std::chrono::seconds(10)};
constexpr types::Twist2 kForward{0.5, 0.0};

struct StopZone : testing::Test {
  std::unique_ptr<types::Scan> scan = empty_scan(kNow);
  types::RobotLimits limits;
  std::array<types::SonarReading, 32> sonar{};
  std::array<types::Se2, 2> poses{types::Se2{0.15, 0.0, 0.0}, types::Se2{-0.25, 0.0, std::numbers::pi}};
  types::Se2 mount{0.1, 0.0, 0.0};

  [[nodiscard]] double free_m(const types::Twist2& twist = kForward) const {
    const Surroundings around{
        .front_scan = scan.get(), .T_base_laser = mount, .sonar = sonar, .T_base_sonar = poses, .now = kNow};
    return free_distance_m(twist, free_time_s(twist, limits, around));
  }
};

TEST_F(StopZone, NothingAheadIsFree) {
  EXPECT_EQ(free_m(), kNever_s);
  EXPECT_EQ(free_m({std::nan(""), 0.0}), 0.0);
}

TEST_F(StopZone, MeasuresFromTheFrontWithTheMargin) {
  put_wall_ahead(*scan, 2.0);
  EXPECT_NEAR(free_m(), 2.0 + 0.1 - 0.21 - 0.05, 1e-3);
}

TEST_F(StopZone, AnArcPassesWhatStraightAheadMeets) {
  scan->range_m[kAhead] = 1.0F;  // a post
  EXPECT_LT(free_m(), 1.0);
  EXPECT_EQ(free_m({0.3, 1.2}), kNever_s);
}

TEST_F(StopZone, ALoneDropoutIsBridged) {
  for (const std::size_t width : {1U, 2U, 3U}) {
    for (std::size_t i = 0; i < width; ++i) scan->range_m[kAhead + i] = types::kInvalid;
    EXPECT_EQ(free_m(), kNever_s) << width;
  }
  put_wall_ahead(*scan, 2.0);
  scan->range_m[kAhead] = types::kInvalid;
  EXPECT_NEAR(free_m(), 1.84, 1e-3);
}

TEST_F(StopZone, ADropoutBesideAPostIsPartOfThePost) {
  scan->range_m[kAhead] = 1.0F;
  scan->range_m[kAhead + 1] = types::kInvalid;
  scan->range_m[kAhead + 2] = 3.0F;
  EXPECT_NEAR(free_m(), 1.0 + 0.1 - 0.26, 1e-2);
}

TEST_F(StopZone, AWideGapOfInvalidBeamsAheadIsAnObstacle) {
  for (std::size_t i = 0; i < 4; ++i) scan->range_m[kAhead + i] = types::kInvalid;
  EXPECT_EQ(free_m(), 0.0);
}

TEST_F(StopZone, InvalidBeamsOutsideTheForwardSectorDoNotCount) {
  for (std::size_t i = 0; i < 200; ++i) scan->range_m[i] = types::kInvalid;  // right and behind
  EXPECT_EQ(free_m(), kNever_s);
}

TEST_F(StopZone, TooNearAheadIsAnObstacle) {
  scan->range_m[kAhead + 30] = types::kTooNear;
  EXPECT_EQ(free_m(), 0.0);
  scan->range_m[kAhead + 30] = types::kNoReturn;
  scan->range_m[10] = types::kTooNear;
  EXPECT_EQ(free_m(), kNever_s);
}

TEST_F(StopZone, TheRobotsOwnBodyBesideTheLaserIsNoObstacle) {
  scan->range_m[kAhead + 400] = 0.15F;  // 100 degrees to the left, within the outline
  EXPECT_EQ(free_m(), kNever_s);
  scan->range_m[kAhead] = 0.105F;  // ahead, within the outline
  EXPECT_EQ(free_m(), 0.0);
}

TEST_F(StopZone, ATurnedMountTurnsTheSector) {
  mount.theta_rad = std::numbers::pi / 2;
  for (std::size_t i = 0; i < 4; ++i) scan->range_m[kAhead + i] = types::kInvalid;  // now to the left
  EXPECT_EQ(free_m(), kNever_s);
  scan->range_m[kAhead - 360] = 1.0F;  // now ahead
  EXPECT_NEAR(free_m(), 0.84, 1e-3);
}

TEST_F(StopZone, SonarSeesWhatTheLaserDoesNot) {
  sonar[0] = {kNow, 1.0F};
  EXPECT_NEAR(free_m(), 0.15 + 1.0 - 0.26, 1e-6);
  sonar[0].range_m = 5.0F;  // nothing seen
  EXPECT_EQ(free_m(), kNever_s);
}

TEST_F(StopZone, OldSonarReadingsDoNotCount) {
  sonar[0] = {kNow - std::chrono::milliseconds(501), 1.0F};
  EXPECT_EQ(free_m(), kNever_s);
  sonar[0] = {Stamp{}, 1.0F};
  EXPECT_EQ(free_m(), kNever_s);
  sonar[5] = {kNow, 1.0F};  // no pose is known
  EXPECT_EQ(free_m(), kNever_s);
}

TEST_F(StopZone, RearSonarGuardsTheWayBack) {
  sonar[1] = {kNow, 0.5F};
  EXPECT_EQ(free_m(), kNever_s);
  EXPECT_NEAR(free_m({-0.1, 0.0}), 0.25 + 0.5 - 0.301 - 0.05, 1e-6);
}

TEST_F(StopZone, CountsValidBeamsOfTheForwardSectorOnly) {
  EXPECT_EQ(forward_valid_fraction(*scan, mount), 1.0);
  for (std::size_t i = kAhead; i < 1081; ++i) scan->range_m[i] = types::kInvalid;
  EXPECT_NEAR(forward_valid_fraction(*scan, mount), 0.5, 0.01);
  scan->beams = 0;
  EXPECT_EQ(forward_valid_fraction(*scan, mount), 0.0);
}

TEST_F(StopZone, DirectionsWithoutABeamAreNotSeen) {
  const auto fraction_at = [&](double yaw_deg) {
    return forward_valid_fraction(*scan, {0.1, 0.0, yaw_deg * types::kDegree_rad});
  };
  // The view of 270 degrees contains the forward sector up to a turn of 75 degrees.
  for (const double yaw_deg : {-75.0, -30.0, 0.1, 74.9})
    EXPECT_NEAR(fraction_at(yaw_deg), 1.0, 0.003) << yaw_deg;
  EXPECT_NEAR(fraction_at(105.0), 0.75, 0.01);
  EXPECT_NEAR(fraction_at(-135.0), 0.5, 0.01);
  EXPECT_NEAR(fraction_at(180.0), 0.25, 0.01);
  scan->beams = 361;  // from -135 to -45 degrees
  EXPECT_NEAR(fraction_at(0.0), 0.125, 0.01);
}

TEST_F(StopZone, AScanWithoutAStepBetweenBeamsSeesNothing) {
  for (const float step_rad : {0.0F, std::nanf(""), HUGE_VALF}) {
    scan->geometry.angle_min_rad = 0.0F;
    scan->geometry.angle_increment_rad = step_rad;
    EXPECT_EQ(forward_valid_fraction(*scan, mount), 0.0) << step_rad;
  }
}

TEST_F(StopZone, CoarseAndDenseScansAreSeenWhole) {
  for (const int beams : {181, 361, 721}) {
    scan->beams = static_cast<std::uint16_t>(beams);
    scan->geometry.angle_min_rad = -std::numbers::pi_v<float> / 2.0F;
    scan->geometry.angle_increment_rad = std::numbers::pi_v<float> / static_cast<float>(beams - 1);
    EXPECT_EQ(forward_valid_fraction(*scan, mount), 1.0) << beams;
  }
}

}  // namespace
}  // namespace topo::perception

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/unseen_echoes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <optional>

namespace topo::perception {
namespace {

using types::Vector2;

/// A robot with one sonar straight ahead and one to the left, a laser of 270 degrees that sees everything at
/// one range.
struct Robot {
  explicit Robot(float laser_range_m) {
    scan.beams = 1081;
    scan.geometry.angle_min_rad = -2.3562F;
    scan.geometry.angle_increment_rad = 0.0043633F;
    scan.range_m.fill(laser_range_m);
    around.front_scan = &scan;
    around.now = types::stamp_from_seconds(10.0);
    around.sonar = sonar;
    around.T_base_sonar = T_base_sonar;
    for (auto& echo : sonar) echo = {around.now - std::chrono::milliseconds(50), 5.0F};
  }
  std::size_t count() {
    UnseenEchoParams params;
    params.range_max_m = 1.5;
    return unseen_echoes(around, params, out);
  }
  types::Scan scan;
  std::array<types::SonarReading, 2> sonar;
  std::array<types::Se2, 2> T_base_sonar{types::Se2{0.17, 0.0, 0.0}, types::Se2{0.07, 0.136, 1.5708}};
  Surroundings around;
  std::array<Vector2, 8> out;
};

TEST(UnseenEchoes, whatTheLaserDoesNotSeeIsReported) {
  Robot robot(4.0F);
  EXPECT_EQ(robot.count(), 0U);
  robot.sonar[0].range_m = 0.8F;
  ASSERT_EQ(robot.count(), 1U);
  EXPECT_NEAR(robot.out[0].x(), 0.97, 1e-6);
  EXPECT_NEAR(robot.out[0].y(), 0.0, 1e-6);
  robot.sonar[1].range_m = 0.6F;
  ASSERT_EQ(robot.count(), 2U);
  EXPECT_NEAR(robot.out[1].y(), 0.736, 1e-4);
}

TEST(UnseenEchoes, whatTheLaserSeesIsNot) {
  Robot robot(0.9F);
  robot.sonar[0].range_m = 0.75F;
  EXPECT_EQ(robot.count(), 0U);
  // Something in front of the echo, only a hand wide.
  robot = Robot(4.0F);
  robot.around.front_scan = &robot.scan;
  robot.around.sonar = robot.sonar;
  robot.around.T_base_sonar = robot.T_base_sonar;
  robot.sonar[0].range_m = 0.75F;
  for (std::size_t i = 560; i < 580; ++i) robot.scan.range_m[i] = 0.9F;
  EXPECT_EQ(robot.count(), 0U);
}

TEST(UnseenEchoes, oldFarAndRearEchoesSayNothing) {
  Robot robot(4.0F);
  robot.sonar[0] = {robot.around.now - std::chrono::milliseconds(400), 0.8F};
  EXPECT_EQ(robot.count(), 0U);
  robot.sonar[0] = {robot.around.now, 1.6F};
  EXPECT_EQ(robot.count(), 0U);
  robot.sonar[0] = {types::Stamp{}, 0.8F};
  EXPECT_EQ(robot.count(), 0U);
  robot.sonar[0] = {robot.around.now, 0.8F};
  robot.T_base_sonar[0].theta_rad = 3.0;
  EXPECT_EQ(robot.count(), 0U);
  robot.around.front_scan = nullptr;
  EXPECT_EQ(robot.count(), 0U);
}

/// The rule as the header has it, beam by beam, with an angle for each: true, false, or neither when the scan
/// has a point so near to the cone's rim that rounding decides.
std::optional<bool> is_seen_nearby(const Surroundings& around, const types::Se2& T_base_sonar,
                                   double range_m) {
  constexpr double kRim = 1e-5;
  const types::Se2 T_sonar_laser = T_base_sonar.inverse() * around.T_base_laser;
  const types::Scan& scan = *around.front_scan;
  bool seen = false, surely = false;
  for (std::size_t i = 0; i < scan.beams; ++i) {
    if (!types::is_hit(scan.range_m[i])) continue;
    const double beam_m = static_cast<double>(scan.range_m[i]);
    const double angle_rad = static_cast<double>(scan.angle_rad(i));
    const Vector2 p = T_sonar_laser * Vector2(beam_m * std::cos(angle_rad), beam_m * std::sin(angle_rad));
    const double off_rad = std::abs(std::atan2(p.y(), p.x()));
    const auto within = [&](double rim) { return p.norm() <= range_m + 0.30 + rim && off_rad <= 0.30 + rim; };
    seen = seen || within(kRim);
    surely = surely || within(-kRim);
  }
  return seen == surely ? std::optional(seen) : std::nullopt;
}

TEST(UnseenEchoes, lookingAtSomeBeamsOnlyFindsWhatAllWouldHave) {
  int seen = 0, unseen = 0;
  EXPECT_TRUE(rc::check("any scan, any mounts", [&] {
    const auto uniform = [](double low, double high) {
      return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1000001);
    };
    Robot robot(4.0F);
    robot.scan.beams = static_cast<std::uint16_t>(*rc::gen::inRange(0, 1400));
    robot.scan.geometry.angle_min_rad = static_cast<float>(uniform(-3.14, -0.5));
    const int dense = *rc::gen::inRange(1, 40);  // one beam in so many measures something near
    for (std::size_t i = 0; i < robot.scan.beams; ++i) {
      const std::array<float, 4> others{types::kInvalid, types::kNoReturn, types::kTooNear, 6.0F};
      const auto k = static_cast<std::size_t>(*rc::gen::inRange(0, 4));
      robot.scan.range_m[i] =
          *rc::gen::inRange(0, dense) == 0 ? static_cast<float>(uniform(0.02, 3.0)) : others[k];
    }
    robot.around.T_base_laser = {uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-3.2, 3.2)};
    robot.T_base_sonar[0] = {uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-1.7, 1.7)};
    const double range_m = uniform(0.16, 1.49);
    robot.sonar[0].range_m = static_cast<float>(range_m);
    const auto all =
        is_seen_nearby(robot.around, robot.T_base_sonar[0], static_cast<double>(robot.sonar[0].range_m));
    RC_PRE(all.has_value());
    ++(*all ? seen : unseen);
    RC_ASSERT(robot.count() == (*all ? 0U : 1U));
  }));
  EXPECT_GT(seen, 10);
  EXPECT_GT(unseen, 10);
}

}  // namespace
}  // namespace topo::perception

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/dead_reckoning.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;

constexpr double kPi = std::numbers::pi;

StatusPacket status(int x, int y, int heading) {
  StatusPacket p;
  p.x_counts = static_cast<std::uint16_t>(x & 0x7FFF);
  p.y_counts = static_cast<std::uint16_t>(y & 0x7FFF);
  p.heading_units = static_cast<std::int16_t>(heading);
  return p;
}

DeadReckoning started(const char* model = "p3dx-sh") {
  DeadReckoning d;
  d.restart(*find_model(model), 1.5, 6.3);
  return d;
}

TEST(CounterDifference, GoesTheShortestWay) {
  EXPECT_EQ(counter_difference(5, 32766, 32768), 7);
  EXPECT_EQ(counter_difference(32766, 5, 32768), -7);
  EXPECT_EQ(counter_difference(-2048, 2047, 4096), 1);
  EXPECT_EQ(counter_difference(4095, 0, 4096), -1);
  EXPECT_EQ(counter_difference(100, 100, 4096), 0);
}

TEST(DeadReckoning, FirstPacketOnlyInitialises) {
  auto d = started();
  EXPECT_EQ(d.update(status(12345, 999, 0), milliseconds(100)), DeadReckoning::Update::kInitialised);
  EXPECT_EQ(d.T_odom_base(), types::Se2{});
}

TEST(DeadReckoning, ConvertsCountsByModel) {
  auto d = started("p3dx");
  d.update(status(0, 0, 0), milliseconds(100));
  EXPECT_EQ(d.update(status(100, -40, 1024), milliseconds(500)), DeadReckoning::Update::kMoved);
  EXPECT_NEAR(d.T_odom_base().x_m, 0.0485, 1e-12);
  EXPECT_NEAR(d.T_odom_base().y_m, -0.0194, 1e-12);
  EXPECT_NEAR(d.T_odom_base().theta_rad, kPi / 2, 1e-12);
}

TEST(DeadReckoning, AnyPathSurvivesTheWrapAround) {
  EXPECT_TRUE(rc::check([] {
    const int x0 = *rc::gen::inRange(0, 32768), y0 = *rc::gen::inRange(0, 32768);
    const bool sixteen_bits = *rc::gen::arbitrary<bool>();
    const auto steps = *rc::gen::container<std::vector<std::tuple<int, int, int>>>(
        600, rc::gen::tuple(rc::gen::inRange(-150, 151), rc::gen::inRange(-150, 151),
                            rc::gen::inRange(-300, 301)));
    auto d = started();
    int x = x0, y = y0, heading = 0;
    d.update(status(x, y, heading), milliseconds(100));
    for (const auto& [dx, dy, dh] : steps) {
      x += dx;
      y += dy;
      heading += dh;
      auto p = status(x, y, counter_difference(heading, 0, 4096));
      if (sixteen_bits) p.x_counts = static_cast<std::uint16_t>(x & 0xFFFF);
      RC_ASSERT(d.update(p, milliseconds(200)) == DeadReckoning::Update::kMoved);
    }
    RC_ASSERT(std::abs(d.T_odom_base().x_m - (x - x0) * 1e-3) < 1e-9);
    RC_ASSERT(std::abs(d.T_odom_base().y_m - (y - y0) * 1e-3) < 1e-9);
    const double expected = heading * 2 * kPi / 4096;
    RC_ASSERT(std::abs(types::wrap_angle(d.T_odom_base().theta_rad - expected)) < 1e-9);
  }));
}

TEST(DeadReckoning, AJumpKeepsThePoseAndStartsAgain) {
  auto d = started();
  d.update(status(1000, 1000, 0), milliseconds(100));
  d.update(status(1100, 1000, 0), milliseconds(100));
  EXPECT_EQ(d.update(status(0, 0, 0), milliseconds(100)), DeadReckoning::Update::kJumped);  // counters zeroed
  EXPECT_NEAR(d.T_odom_base().x_m, 0.1, 1e-12);
  EXPECT_EQ(d.update(status(50, 0, 0), milliseconds(100)), DeadReckoning::Update::kMoved);
  EXPECT_NEAR(d.T_odom_base().x_m, 0.15, 1e-12);
}

TEST(DeadReckoning, ALongerGapAllowsALongerWay) {
  auto d = started();
  d.update(status(0, 0, 0), milliseconds(100));
  EXPECT_EQ(d.update(status(1000, 0, 0), milliseconds(1000)), DeadReckoning::Update::kMoved);
  EXPECT_EQ(d.update(status(2000, 0, 0), milliseconds(100)), DeadReckoning::Update::kJumped);
}

TEST(DeadReckoning, AReconnectGoesOnFromTheLastPoseAndHeading) {
  auto d = started();
  d.update(status(0, 0, 0), milliseconds(100));
  d.update(status(100, 0, 100), milliseconds(100));
  d.update(status(100, 0, 400), milliseconds(100));
  d.update(status(100, 0, 700), milliseconds(100));
  d.update(status(100, 0, 1024), milliseconds(100));  // stands at (0.1, 0), looks left
  d.restart(*find_model("p3dx-sh"), 1.5, 6.3);
  d.update(status(0, 0, 0), milliseconds(100));   // the robot's own frame begins anew
  d.update(status(80, 0, 0), milliseconds(100));  // 80 mm ahead, which is to the left in odom
  EXPECT_NEAR(d.T_odom_base().x_m, 0.1, 1e-9);
  EXPECT_NEAR(d.T_odom_base().y_m, 0.08, 1e-9);
  EXPECT_NEAR(d.T_odom_base().theta_rad, kPi / 2, 1e-9);
}

TEST(DeadReckoning, ACalibratedRobotGoesItsOwnWay) {
  DeadReckoning d;
  d.restart(*find_model("p3dx-sh"), 1.5, 6.3, {1.04, 1.04, 0.0});
  d.update(status(0, 0, 1024), milliseconds(100));
  d.update(status(0, 100, 1024), milliseconds(100));  // ahead, as its firmware looks north
  EXPECT_NEAR(d.T_odom_base().x_m, 0.104, 1e-9);
  EXPECT_NEAR(d.T_odom_base().y_m, 0.0, 1e-9);
  EXPECT_NEAR(d.T_odom_base().theta_rad, 0.0, 1e-9);
}

TEST(DeadReckoning, AWiderTrackTurnsLess) {
  DeadReckoning d;
  d.restart(*find_model("p3dx-sh"), 1.5, 6.3, {1.0, 1.0, 2.0 * 2e-3 / 0.0056});
  d.update(status(0, 0, 0), milliseconds(100));
  for (int i = 1; i <= 8; ++i) d.update(status(0, 0, 64 * i), milliseconds(100));
  EXPECT_NEAR(d.T_odom_base().theta_rad, 256 * radians_per_heading_unit(), 1e-9);
}

TEST(DeadReckoning, TheGyroTurnsInPlaceOfTheWheels) {
  auto d = started();
  d.update(status(0, 0, 0), milliseconds(100));
  d.update(status(0, 0, 100), milliseconds(100), 0.1);
  EXPECT_NEAR(d.T_odom_base().theta_rad, 0.1, 1e-9);
  // Without it, the wheels' turn goes on from there.
  d.update(status(0, 0, 150), milliseconds(100));
  EXPECT_NEAR(d.T_odom_base().theta_rad, 0.1 + 50 * radians_per_heading_unit(), 1e-9);
}

TEST(DeadReckoning, StandsWhileNothingIsCounted) {
  auto d = started();
  EXPECT_FALSE(d.stands(status(5, 6, 7)));
  d.update(status(5, 6, 7), milliseconds(100));
  EXPECT_TRUE(d.stands(status(5, 6, 7)));
  EXPECT_FALSE(d.stands(status(5, 6, 8)));
  auto moving = status(5, 6, 7);
  moving.left_velocity = 3;
  EXPECT_FALSE(d.stands(moving));
}

}  // namespace
}  // namespace topo::pioneer

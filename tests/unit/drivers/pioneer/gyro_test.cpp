// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/gyro.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "core/types/se2.hpp"

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;

constexpr types::Duration kCycle = milliseconds(100);
constexpr int kRest = 516;  ///< of this gyro: 4 units beside the middle

GyroPacket readings(std::initializer_list<int> values) {
  GyroPacket packet;
  for (const int value : values) packet.reading[packet.count++] = static_cast<std::uint16_t>(value);
  return packet;
}

std::optional<double> cycle(Gyro& gyro, int reading, bool wheels_stand, bool faulty = false) {
  gyro.take(readings({reading, reading, reading, reading}));
  return gyro.turn_rad(kCycle, wheels_stand, faulty);
}

Gyro rested(int rest = kRest) {
  Gyro gyro;
  for (int i = 0; i < 15; ++i) cycle(gyro, rest, true);
  return gyro;
}

TEST(GyroPacket, IsDecodedByItsCount) {
  const std::array<std::byte, 8> payload{std::byte{0x98}, std::byte{2},    std::byte{0x04}, std::byte{0x02},
                                         std::byte{30},   std::byte{0xF0}, std::byte{0x01}, std::byte{31}};
  const auto packet = decode_gyro(payload);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->count, 2U);
  EXPECT_EQ(packet->reading[0], 516);
  EXPECT_EQ(packet->reading[1], 496);
}

TEST(GyroPacket, ThatEndsEarlyIsNone) {
  const std::array<std::byte, 8> payload{std::byte{0x98}, std::byte{3},    std::byte{0x04}, std::byte{0x02},
                                         std::byte{30},   std::byte{0xF0}, std::byte{0x01}, std::byte{31}};
  EXPECT_FALSE(decode_gyro(payload));
  EXPECT_FALSE(decode_gyro(std::span(payload).first(1)));
  EXPECT_FALSE(decode_gyro({}));
  auto other = payload;
  other[0] = std::byte{0x90};
  EXPECT_FALSE(decode_gyro(other));
}

TEST(Gyro, GivesNothingBeforeItsRestIsKnown) {
  Gyro gyro;
  EXPECT_FALSE(cycle(gyro, kRest, false));
  for (int i = 0; i < 8; ++i) EXPECT_FALSE(cycle(gyro, kRest, true));
  EXPECT_FALSE(gyro.rest());
}

TEST(Gyro, LearnsItsRestWhileTheWheelsStand) {
  const Gyro gyro = rested();
  ASSERT_TRUE(gyro.rest());
  EXPECT_DOUBLE_EQ(*gyro.rest(), kRest);
}

TEST(Gyro, LessThanRestIsToTheLeft) {
  Gyro gyro = rested();
  const auto turn = cycle(gyro, kRest - 30, false);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(*turn, 30 * 0.9537 * types::kDegree_rad * 0.1, 1e-4);
  EXPECT_LT(*cycle(gyro, kRest + 30, false), 0.0);
}

TEST(Gyro, AStandingRobotDoesNotTurn) {
  Gyro gyro = rested();
  EXPECT_EQ(cycle(gyro, kRest + 1, true), 0.0);
}

TEST(Gyro, FeelsThatAStandingRobotIsTurned) {
  Gyro gyro = rested();
  for (int i = 0; i < 40; ++i) EXPECT_GT(cycle(gyro, kRest - 20, true).value_or(0.0), 0.0);
  EXPECT_DOUBLE_EQ(*gyro.rest(), kRest);
}

TEST(Gyro, FollowsTheDriftOfItsRest) {
  Gyro gyro = rested();
  for (int i = 0; i < 15; ++i) cycle(gyro, kRest + 1, true);
  EXPECT_NEAR(*gyro.rest(), kRest + 1, 0.5);
}

TEST(Gyro, MissingReadingsLeaveTheTurnToTheWheels) {
  Gyro gyro = rested();
  EXPECT_FALSE(gyro.turn_rad(kCycle, false, false));
  EXPECT_TRUE(cycle(gyro, kRest, false));
}

TEST(Gyro, AFaultOrAClippedReadingIsNoTurn) {
  Gyro gyro = rested();
  EXPECT_FALSE(cycle(gyro, kRest, false, true));
  EXPECT_FALSE(cycle(gyro, 1023, false));
  EXPECT_FALSE(cycle(gyro, 0, false));
  EXPECT_TRUE(cycle(gyro, kRest, false));
}

TEST(Gyro, ARestFarFromTheMiddleIsABrokenSensor) { EXPECT_FALSE(rested(700).rest()); }

}  // namespace
}  // namespace topo::pioneer

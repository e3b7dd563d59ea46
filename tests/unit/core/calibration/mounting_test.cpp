// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/mounting.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/bench/topobench/calibrate/standing.hpp"

namespace topo::calibration {
namespace {

using bench::Standing;
using sim::Vector2;

constexpr double kYawMax_rad = 1.308;

double between(double low, double high) {
  constexpr int kSteps = 10'000;
  // All of the range from the first case on.
  const auto any = rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, kSteps + 1));
  return low + (high - low) * *any / kSteps;
}

/// Somebody who was told to stand 1 m before the robot, or beside it, and stands about there.
Vector2 about_ahead() { return {between(1.0, 1.5), between(-0.15, 0.15)}; }
Vector2 about_left() { return {between(-0.05, 0.2), between(0.9, 1.3)}; }

Standing any_standing() {
  Standing s;
  s.level.yaw_rad = between(-1.1, 1.1);
  s.level.mirrored = *rc::gen::arbitrary<bool>();
  s.upright.roll_rad = between(-0.3, 0.3);
  s.upright.mirrored = *rc::gen::arbitrary<bool>();
  s.upright.z_m = between(0.25, 0.9);
  s.pose = {between(3.4, 4.6), between(2.5, 3.5), between(-3.1, 3.1)};
  s.seed = *rc::gen::inRange<std::uint64_t>(1, 1'000'000);
  return s;
}

RC_GTEST_PROP(Mounting, WhoStandsAheadTellsTheLevelScanner, ()) {
  const Standing s = any_standing();
  const bool swapped = *rc::gen::arbitrary<bool>();
  auto empty = s.both({}), ahead = s.both({about_ahead()});
  if (swapped) std::swap(empty[0], empty[1]), std::swap(ahead[0], ahead[1]);
  const auto told = level_scanner(empty, ahead, kYawMax_rad);
  RC_ASSERT(std::holds_alternative<AheadSeen>(told));
  RC_ASSERT(std::get<AheadSeen>(told).scanner == (swapped ? 1U : 0U));
}

RC_GTEST_PROP(Mounting, WhoStandsToTheLeftTellsUpFromDown, ()) {
  const Standing s = any_standing();
  const Vector2 left = about_left();
  const auto empty = s.both({}), ahead = s.both({about_ahead()}), now = s.both({left});
  const auto seen = level_scanner(empty, ahead, kYawMax_rad);
  RC_ASSERT(std::holds_alternative<AheadSeen>(seen));
  const auto level = level_mount(std::get<AheadSeen>(seen).angle_rad, empty[0], now[0]);
  // Where its view ends before the left there is nobody to see.
  const double half_view = 135.0 * types::kDegree_rad;
  const double left_in_scan =
      (std::atan2(left.y(), left.x()) - s.level.yaw_rad) * (s.level.mirrored ? -1.0 : 1.0);
  if (std::abs(types::wrap_angle(left_in_scan)) > half_view - 0.2) RC_DISCARD("the left is out of its view");
  RC_ASSERT(std::holds_alternative<LevelMount>(level));
  const auto& mount = std::get<LevelMount>(level);
  RC_ASSERT(mount.mirrored == s.level.mirrored);
  constexpr double kStanding_rad = 12.0 * types::kDegree_rad;
  RC_ASSERT(std::abs(types::wrap_angle(mount.yaw_rad - s.level.yaw_rad)) < kStanding_rad);
}

RC_GTEST_PROP(Mounting, TheFloorTellsRollAndHeight, ()) {
  const Standing s = any_standing();
  const auto told = upright_mount(s.seen(s.upright, {}), s.seen(s.upright, {about_left()}));
  RC_ASSERT(std::holds_alternative<UprightMount>(told));
  const auto& mount = std::get<UprightMount>(told);
  RC_ASSERT(mount.mirrored == s.upright.mirrored);
  RC_ASSERT(std::abs(types::wrap_angle(mount.roll_rad - s.upright.roll_rad)) < 0.02);
  RC_ASSERT(std::abs(mount.z_m - s.upright.z_m) < 0.03);
}

/// A scanner that is turned far sees the floor on one side only.
RC_GTEST_PROP(Mounting, AFloorThatIsHardlySeenIsNoneOrTheRightOne, ()) {
  Standing s = any_standing();
  s.upright.roll_rad = between(-3.14, 3.14);
  const auto told = upright_mount(s.seen(s.upright, {}), s.seen(s.upright, {about_left()}));
  const auto* mount = std::get_if<UprightMount>(&told);
  if (mount == nullptr) return;
  RC_ASSERT(mount->mirrored == s.upright.mirrored);
  RC_ASSERT(std::abs(types::wrap_angle(mount->roll_rad - s.upright.roll_rad)) < 0.1);
}

MountDoubt doubt_of(const MountResult<AheadSeen>& told) {
  const auto* doubt = std::get_if<MountDoubt>(&told);
  return doubt != nullptr ? *doubt : MountDoubt::kNoFloor;
}

TEST(Mounting, NobodyIsNobody) {
  Standing later;
  later.seed = 2;
  EXPECT_EQ(doubt_of(level_scanner(Standing{}.both({}), later.both({}), kYawMax_rad)), MountDoubt::kNobody);
}

TEST(Mounting, TwoPeopleAreTooMany) {
  const Standing s;
  EXPECT_EQ(doubt_of(level_scanner(s.both({}), s.both({{1.2, 0.0}, {-0.5, -1.3}}), kYawMax_rad)),
            MountDoubt::kSeveral);
}

TEST(Mounting, TwoLevelScannersAreNotToldApart) {
  Standing s;
  s.upright = s.level;
  s.upright.z_m = 0.5;
  EXPECT_EQ(doubt_of(level_scanner(s.both({}), s.both({{1.2, 0.0}}), kYawMax_rad)), MountDoubt::kBothAhead);
}

TEST(Mounting, WhoWasThereBeforeDoesNotCount) {
  const Standing s;
  const auto told = level_scanner(s.both({{-0.9, 0.9}}), s.both({{-0.9, 0.9}, {1.2, 0.0}}), kYawMax_rad);
  ASSERT_TRUE(std::holds_alternative<AheadSeen>(told));
  EXPECT_NEAR(std::get<AheadSeen>(told).angle_rad, 0.0, 0.02);
}

TEST(Mounting, WhoStandsBehindIsNotAhead) {
  const Standing s;
  EXPECT_EQ(doubt_of(level_scanner(s.both({}), s.both({{-0.9, 1.0}}), kYawMax_rad)), MountDoubt::kLooksAside);
}

TEST(Mounting, WhoDidNotMoveIsNotBeside) {
  const Standing s;
  const auto told = level_mount(0.0, s.seen(s.level, {}), s.seen(s.level, {{1.2, 0.0}}));
  ASSERT_TRUE(std::holds_alternative<MountDoubt>(told));
  EXPECT_EQ(std::get<MountDoubt>(told), MountDoubt::kNotBeside);
}

TEST(StillPicture, AScanWithOtherBeamsBeginsAnew) {
  PictureTaker taker;
  types::Scan scan;
  scan.beams = 3;
  scan.range_m[0] = scan.range_m[1] = 2.0F;
  scan.range_m[2] = types::kInvalid;
  taker.add(scan);
  scan.range_m[0] = 2.1F;
  taker.add(scan);
  ASSERT_EQ(taker.scans(), 2U);
  EXPECT_EQ(taker.picture().range_m, (std::vector<float>{2.1F, 2.0F, types::kNoReturn}));
  scan.beams = 2;
  taker.add(scan);
  EXPECT_EQ(taker.scans(), 1U);
  EXPECT_EQ(PictureTaker().picture().range_m.size(), 0U);
}

}  // namespace
}  // namespace topo::calibration

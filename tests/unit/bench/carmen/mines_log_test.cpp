// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/types/scan.hpp"
#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using ::testing::HasSubstr;

std::string mines_line(int time_us, int left, int right, int range_mm) {
  std::string line = std::to_string(time_us) + " 7 " + std::to_string(left) + " " + std::to_string(right);
  for (int i = 4; i < 24; ++i) line += " 0";
  line += " ";  // the recorder wrote two blanks here
  for (int i = 0; i < 682; ++i) line += " " + std::to_string(range_mm);
  return line + "\n";
}

TEST(MinesLog, IntegratesTheEncodersAndPlacesTheLaser) {
  const daemon::testing::TempDir dir;
  // One radian of both wheels straight ahead (2000 ticks are a revolution of the wheel), then a half turn of
  // the robot to the left on the spot.
  const double ticks_per_rad = 2000.0 / (2.0 * std::numbers::pi);
  const int radian = static_cast<int>(std::lround(ticks_per_rad));
  const int half_turn = static_cast<int>(std::lround(std::numbers::pi * 0.165 / 0.077 * ticks_per_rad));
  const auto log = read_mines_log(dir.write(
      "m.dat", mines_line(1000000, 100, 50, 0) + mines_line(1100000, 100 + radian, 50 + radian, 4500) +
                   mines_line(1200000, 100 + radian - half_turn, 50 + radian + half_turn, 1500)));
  ASSERT_TRUE(log.has_value()) << log.error().message;
  ASSERT_EQ(log->scans.size(), 3U);
  EXPECT_DOUBLE_EQ(log->scans[0].stamp_s, 1.0);
  EXPECT_NEAR(log->scans[1].robot_odom.x_m, 0.077, 1e-4);
  EXPECT_NEAR(log->scans[1].laser_odom.x_m, 0.077 + 0.145, 1e-4);
  EXPECT_NEAR(std::abs(log->scans[2].robot_odom.theta_rad), std::numbers::pi, 2e-3);
  EXPECT_NEAR(log->scans[2].laser_odom.x_m, 0.077 - 0.145, 1e-3);
  EXPECT_NEAR(log->odometry[1].v_mps, 0.77, 1e-3);
  EXPECT_TRUE(std::isnan(log->scans[0].range_m[0]));
  EXPECT_EQ(log->scans[1].range_m[681], types::kNoReturn);
  EXPECT_FLOAT_EQ(log->scans[2].range_m[340], 1.5F);
  EXPECT_NEAR(1024.0F * log->scans[0].time_increment_s, 0.1F, 1e-6F);
  EXPECT_NEAR(log->scans[0].angle_min_rad + 340.0F * log->scans[0].angle_increment_rad, 0.0, 1e-5);
}

TEST(MinesLog, SaysWhereAndWhatIsWrong) {
  const daemon::testing::TempDir dir;
  const std::string good = mines_line(1, 1, 1, 1000);
  struct Case {
    std::string text, message;
  };
  for (const Case& c :
       {Case{"", "found no scan"}, Case{good + "1 2 3\n", "m.dat:2: found 3 columns, expected 706"},
        Case{"x" + good,
             "found no scan, but passed over 1 line without a time at the beginning: 1 of x1 (line 1)"},
        Case{good.substr(0, good.size() - 300),
             "found no scan, but passed over the last line, 1, which was cut"}}) {
    const auto log = read_mines_log(dir.write("m.dat", c.text));
    ASSERT_FALSE(log.has_value());
    EXPECT_THAT(log.error().message, HasSubstr(c.message));
  }
}

TEST(MinesLog, PassesOverForeignLinesAndACutEnd) {
  const daemon::testing::TempDir dir;
  const std::string a = mines_line(1, 1, 1, 1000), b = mines_line(2, 1, 1, 1000);
  const auto log = read_mines_log(dir.write("m.dat", "\xEF\xBB\xBF# by hand\n" + a + b + b.substr(0, 700)));
  ASSERT_TRUE(log.has_value()) << log.error().message;
  EXPECT_EQ(log->scans.size(), 2U);
  EXPECT_EQ(log->odometry.size(), 2U);
  EXPECT_EQ(log->foreign_lines, 1);
  EXPECT_EQ(log->remarks.size(), 2U);
}

}  // namespace
}  // namespace topo::bench

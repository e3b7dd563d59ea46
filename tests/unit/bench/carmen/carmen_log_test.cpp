// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/carmen_log.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <cmath>

#include "core/types/scan.hpp"
#include "tests/unit/bench/carmen/sample_log.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using testing::bzip2;
using ::testing::ElementsAre;
using testing::gzip;
using ::testing::HasSubstr;
using testing::kSampleLog;
using types::Errc;

/// The samples have a few beams only, as no scanner has.
const LogOptions kFewBeams{.beams = BeamAngles{.first_rad = -1.5, .step_rad = 0.5},
                           .odometry_gap_max_s = 1.0};

class CarmenLogTest : public ::testing::Test {
 protected:
  void expect_error(const std::string& content, const std::string& text) {
    const auto log = read_carmen_log(dir_.write("bad.clf", content), kFewBeams);
    ASSERT_FALSE(log.has_value()) << "expected an error with: " << text;
    EXPECT_EQ(log.error().code, Errc::kInvalidInput);
    EXPECT_THAT(log.error().message, HasSubstr("bad.clf"));
    EXPECT_THAT(log.error().message, HasSubstr(text));
  }
  daemon::testing::TempDir dir_;
};

void expect_sample(const CarmenLog& log) {
  ASSERT_EQ(log.scans.size(), 2U);
  EXPECT_EQ(log.stamp_inversions, 1);
  EXPECT_EQ(log.other_lines, 1);
  EXPECT_DOUBLE_EQ(log.scans[0].stamp_s, 10.2);
  EXPECT_DOUBLE_EQ(log.scans[1].stamp_s, 10.3);
  EXPECT_EQ(log.scans[1].laser_odom, (types::Se2{1.0, 2.0, 0.5}));
  EXPECT_EQ(log.scans[1].robot_odom, (types::Se2{1.1, 2.1, 0.6}));
  EXPECT_FLOAT_EQ(log.scans[1].range_m[0], 1.5F);
  EXPECT_EQ(log.scans[1].range_m[1], types::kNoReturn);
  EXPECT_TRUE(std::isnan(log.scans[1].range_m[2]));
  EXPECT_EQ(log.scans[1].range_m[4], types::kNoReturn);
  ASSERT_EQ(log.odometry.size(), 1U);
  EXPECT_DOUBLE_EQ(log.odometry[0].stamp_s, 10.1);
  EXPECT_DOUBLE_EQ(log.odometry[0].v_mps, 0.3);
  EXPECT_DOUBLE_EQ(log.odometry[0].omega_radps, 0.1);
}

TEST_F(CarmenLogTest, ReadsPlainTextInStampOrder) {
  const auto log = read_carmen_log(dir_.write("a.clf", kSampleLog), kFewBeams);
  ASSERT_TRUE(log.has_value()) << log.error().message;
  expect_sample(*log);
}

TEST_F(CarmenLogTest, ReadsBothPackingsAlsoInSeveralMembers) {
  const std::string head = kSampleLog.substr(0, 100), tail = kSampleLog.substr(100);
  for (const std::string& packed :
       {bzip2(kSampleLog), gzip(kSampleLog), bzip2(head) + bzip2(tail), gzip(head) + gzip(tail)}) {
    const auto log = read_carmen_log(dir_.write("a.clf.packed", packed), kFewBeams);
    ASSERT_TRUE(log.has_value()) << log.error().message;
    expect_sample(*log);
  }
}

TEST_F(CarmenLogTest, KnowsTheAnglesOfTheUsualBeamCounts) {
  struct Case {
    int beams;
    double start_deg, step_deg;
  };
  for (const Case c : {Case{180, -90, 1}, Case{181, -90, 1}, Case{541, -135, 0.5}, Case{1081, -135, 0.25},
                       Case{360, -90, 0.5}, Case{361, -90, 0.5}, Case{401, -50, 0.25}}) {
    std::string line = "FLASER " + std::to_string(c.beams);
    for (int i = 0; i < c.beams; ++i) line += " 1.0";
    const auto log = read_carmen_log(dir_.write("a.clf", line + " 0 0 0 0 0 0 1.0 h 1.0\n"));
    ASSERT_TRUE(log.has_value()) << log.error().message;
    EXPECT_NEAR(log->scans[0].angle_min_rad, c.start_deg * types::kDegree_rad, 1e-6) << c.beams;
    EXPECT_NEAR(log->scans[0].angle_increment_rad, c.step_deg * types::kDegree_rad, 1e-6) << c.beams;
  }
}

TEST_F(CarmenLogTest, ReadsRobotLaserWithItsOwnAnglesAndReach) {
  const auto log =
      read_carmen_log(dir_.write("a.clf",
                                 "ROBOTLASER1 0 -1.57 0.0348 0.0174 50.0 0.01 0 3 1 2 51 2 9 9 1 "
                                 "2 0.1 3 4 0.2 0.5 0.1 0.3 0.2 1e6 7.5 host 0.1\n"
                                 "FLASER 2 1 2 0 0 0 0 0 0 7.5 host 0.1\n"));
  ASSERT_TRUE(log.has_value()) << log.error().message;
  ASSERT_EQ(log->scans.size(), 1U);
  EXPECT_EQ(log->scans_ignored, 1);
  EXPECT_FLOAT_EQ(log->scans[0].angle_min_rad, -1.57F);
  EXPECT_FLOAT_EQ(log->scans[0].angle_increment_rad, 0.0174F);
  EXPECT_THAT(log->scans[0].range_m, ElementsAre(1.0F, 2.0F, types::kNoReturn));
  EXPECT_EQ(log->scans[0].laser_odom, (types::Se2{1, 2, 0.1}));
  EXPECT_EQ(log->scans[0].robot_odom, (types::Se2{3, 4, 0.2}));
  EXPECT_DOUBLE_EQ(log->scans[0].stamp_s, 7.5);
}

TEST_F(CarmenLogTest, SaysWhereAndWhatIsWrong) {
  expect_error("", "found no scan in 0 lines");
  expect_error("PARAM a b 1 h 1\nODOM 0 0 0 0 0 0 1.0 h 1\n", "found no scan in 2 lines");
  expect_error("FLASER 2 1 nan 0 0 0 0 0 0 1 h 1\n", ":1: found \"nan\" in word 4 (range)");
  expect_error("FLASER 2 1 -2 0 0 0 0 0 0 1 h 1\n", "\"-2\" in word 4 (range)");
  expect_error("FLASER 2 1 2 0 inf 0 0 0 0 1 h 1\n", "(laser pose)");
  expect_error("#\nFLASER 2 1 2 0 0 0 0 0 0 nan h 1\n", ":2: found \"nan\" in word 11 (ipc_timestamp)");
  expect_error("FLASER 2 1 2 0 0 0 0 0 0\n", "found 10 words, expected 13");
  expect_error("FLASER 3 1 2 0 0 0 0 0 0 1 h 1\n", "found 13 words, expected 14");
  expect_error("FLASER 99999999999 1 2\n", "(number of ranges)");
  expect_error("FLASER\n", "found 1 words");
  expect_error("ROBOTLASER1 0 -1.57 3.14 0.0174 50.0 0.01 0 3 1 2\n", "found 11 words");
  expect_error("ODOM 0 0 0 0 0 0 host 1.0\n", "found 9 words, expected 10");
  expect_error(
      "\x7f"
      "ELF\x02\x01\n",
      "found no scan in 1 lines, and lines that no CARMEN log has: 1 of ?ELF?? (line 1)");
  expect_error(std::string(3U << 20U, 'A'), "a line of more than");
}

TEST_F(CarmenLogTest, ACutLastLineCostsThatLine) {
  for (const std::size_t cut : {20U, 35U, 45U}) {
    const auto log =
        read_carmen_log(dir_.write("a.clf", kSampleLog.substr(0, kSampleLog.size() - cut)), kFewBeams);
    ASSERT_TRUE(log.has_value()) << log.error().message;
    EXPECT_EQ(log->scans.size(), 1U);
    EXPECT_THAT(log->remarks, ElementsAre(HasSubstr("last line, 5, which is FLASER that was cut off")));
  }
  expect_error(kSampleLog + "FLASER 5 1 2\n" + kSampleLog, ":6: found 4 words");
}

TEST_F(CarmenLogTest, ForeignLinesArePassedOverAndSaidOnce) {
  const auto log = read_carmen_log(
      dir_.write("a.clf", "\xEF\xBB\xBF" + kSampleLog + "$GPGGA,1,2\nimu 1 2\n" + "imu 3 4\n"), kFewBeams);
  ASSERT_TRUE(log.has_value()) << log.error().message;
  expect_sample(*log);
  EXPECT_EQ(log->foreign_lines, 3);
  EXPECT_THAT(log->remarks,
              ElementsAre("passed over 3 lines that no CARMEN log has: 1 of $GPGGA,1,2 (line 6), "
                          "2 of imu (the first in line 7)"));
}

std::string flaser(int beams, const std::string& name = "FLASER") {
  std::string line = name + " " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) line += " 1.0";
  return line + " 1 2 0.5 1 2 0.5 1.0 h 1.0\n";
}

TEST_F(CarmenLogTest, RefusesBeamCountsOfNoKnownScanner) {
  const auto log = read_carmen_log(dir_.write("a.clf", "ODOM 0 0 0 0 0 0 1.0 h 1\n" + flaser(123)));
  ASSERT_FALSE(log.has_value());
  EXPECT_THAT(log.error().message, HasSubstr(":2: found 123 ranges in FLASER"));
  EXPECT_THAT(log.error().message, HasSubstr("180, 181, "));
  EXPECT_THAT(log.error().message, HasSubstr("--beams START,STEP"));
  const auto told = read_carmen_log(dir_.write("a.clf", flaser(123)), kFewBeams);
  ASSERT_TRUE(told.has_value()) << told.error().message;
  EXPECT_FLOAT_EQ(told->scans[0].angle_min_rad, -1.5F);
  EXPECT_FLOAT_EQ(told->scans[0].angle_increment_rad, 0.5F);
}

TEST_F(CarmenLogTest, ParamLinesOfTheScannerHold) {
  struct Case {
    int beams;
    const char* params;
    double start_deg, step_deg;
  };
  for (const Case& c : {Case{181, "PARAM laser_front_laser_resolution 0.5 1 h 1\n", -45.0, 0.5},
                        Case{360, "PARAM laser_front_laser_resolution 0.25 1 h 1\n", -45.0, 0.25},
                        Case{181, "PARAM laser_front_laser_fov 270 1 h 1\n", -135.0, 1.5},
                        Case{123, "PARAM laser_front_laser_resolution 1 1 h 1\n", -61.0, 1.0},
                        Case{181, "PARAM laser_rear_laser_resolution 0.5 1 h 1\n", -90.0, 1.0},
                        Case{181, "PARAM laser_front_laser_resolution on 1 h 1\n", -90.0, 1.0}}) {
    const auto log = read_carmen_log(dir_.write("a.clf", c.params + flaser(c.beams)));
    ASSERT_TRUE(log.has_value()) << log.error().message;
    EXPECT_NEAR(log->scans[0].angle_min_rad, c.start_deg * types::kDegree_rad, 1e-5) << c.params;
    EXPECT_NEAR(log->scans[0].angle_increment_rad, c.step_deg * types::kDegree_rad, 1e-6) << c.params;
  }
  const auto wound =
      read_carmen_log(dir_.write("a.clf", "PARAM laser_front_laser_resolution 2.5 1 h 1\n" + flaser(181)));
  EXPECT_FALSE(wound.has_value()) << "450 degrees";
}

TEST_F(CarmenLogTest, ReachAndPlaceAreThoseOfTheParamLines) {
  const auto log = read_carmen_log(dir_.write("a.clf",
                                              "PARAM robot_front_laser_max 5.0 1 h 1\n"
                                              "PARAM robot_frontlaser_offset 0.2 1 h 1\n"
                                              "FLASER 3 4.9 5.0 7.0 1 2 0 1 2 0 1.0 h 1\n"),
                                   kFewBeams);
  ASSERT_TRUE(log.has_value()) << log.error().message;
  EXPECT_THAT(log->scans[0].range_m, ElementsAre(4.9F, types::kNoReturn, types::kNoReturn));
  EXPECT_NEAR(log->scans[0].laser_odom.x_m, 1.2, 1e-12);
  EXPECT_THAT(log->remarks, ElementsAre(HasSubstr("0.2 m before the robot's centre")));
}

TEST_F(CarmenLogTest, ReadsTheRearLaserWhereItIsAlone) {
  const auto log = read_carmen_log(dir_.write("a.clf", flaser(181, "RLASER")));
  ASSERT_TRUE(log.has_value()) << log.error().message;
  EXPECT_EQ(log->scans.size(), 1U);
  const auto both = read_carmen_log(dir_.write("a.clf", flaser(181, "RLASER") + flaser(361)));
  ASSERT_TRUE(both.has_value()) << both.error().message;
  EXPECT_EQ(both->scans[0].range_m.size(), 361U);
  EXPECT_EQ(both->scans_ignored, 1);
}

const std::string kRaw = "RAWLASER1 0 -1 2 1 50 0.01 0 3 1 2 60 0 ";

TEST_F(CarmenLogTest, ReadsRawScansWithOdometryAroundThem) {
  const auto log = read_carmen_log(dir_.write(
      "a.clf", "ODOM 0 0 0 0 0 0 1.0 h 1\n" + kRaw + "1.25 h 1\n" + "ODOM 1 0 0.4 0 0 0 2.0 h 2\n" + kRaw +
                   "2.5 h 2\n" + kRaw + "0.5 h 0\n" + "PARAM robot_frontlaser_offset 0.1 1 h 1\n"));
  ASSERT_TRUE(log.has_value()) << log.error().message;
  ASSERT_EQ(log->scans.size(), 1U);
  EXPECT_NEAR(log->scans[0].robot_odom.x_m, 0.25, 1e-12);
  EXPECT_NEAR(log->scans[0].robot_odom.theta_rad, 0.1, 1e-12);
  EXPECT_NEAR(log->scans[0].laser_odom.x_m, 0.25 + 0.1 * std::cos(0.1), 1e-12);
  EXPECT_THAT(log->scans[0].range_m, ElementsAre(1.0F, 2.0F, types::kNoReturn));
  EXPECT_THAT(log->remarks,
              ElementsAre(HasSubstr("passed over 2 of 3 RAWLASER1"), HasSubstr("0.1 m before")));
}

TEST_F(CarmenLogTest, NamesWhatALogWithoutScansHolds) {
  expect_error(kRaw + "1.25 h 1\n", "found 1 of RAWLASER1, which have no poses, and 0 of ODOM");
  expect_error("LASER3 1 2\nLASER3 1 2\nODOM 0 0 0 0 0 0 1.0 h 1\n",
               "found no scan in 3 lines, but 1 of ODOM, 2 of LASER3 (the first in line 1)");
}

std::string robotlaser(const std::string& fan, int beams) {
  std::string line = "ROBOTLASER1 0 " + fan + " 50.0 0.01 0 " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) line += " 1";
  return line + " 0 1 2 0 1 2 0 0 0 0 0 0 7.5 host 0.1\n";
}

TEST_F(CarmenLogTest, OfTwoFansTheOneThatLooksAheadHolds) {
  struct Case {
    const char* fan;  ///< start, field of view, resolution
    double step;
    bool said;
  };
  for (const Case& c :
       {Case{"-1 2 0.2", 0.2, false}, Case{"-1 2 0.18", 0.18, false}, Case{"-1 2 0.1", 0.2, true},
        Case{"-1 2 0", 0.2, false}, Case{"-1 3 0.2", 0.2, true}, Case{"0 2 1", 0.2, true}}) {
    const auto log = read_carmen_log(dir_.write("a.clf", robotlaser(c.fan, 11)));
    ASSERT_TRUE(log.has_value()) << log.error().message;
    EXPECT_FLOAT_EQ(log->scans[0].angle_increment_rad, static_cast<float>(c.step)) << c.fan;
    EXPECT_EQ(log->remarks.empty(), !c.said) << c.fan;
  }
}

TEST_F(CarmenLogTest, NamesDamagedAndTruncatedPackedFiles) {
  for (const std::string& packed : {bzip2(kSampleLog), gzip(kSampleLog)}) {
    expect_error(packed.substr(0, packed.size() - 5), "truncated: the file ends inside it");
    std::string damaged = packed;
    damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
    expect_error(damaged, "is damaged");
  }
  const auto log = read_carmen_log(dir_.write("a.clf.bz2", kSampleLog));
  ASSERT_FALSE(log.has_value());
  EXPECT_THAT(log.error().message, HasSubstr("expected bzip2 data"));
}

TEST_F(CarmenLogTest, NamesFilesThatCannotBeRead) {
  const auto missing = read_carmen_log(dir_.file("none.clf"));
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, Errc::kNotFound);
  EXPECT_THAT(missing.error().message, HasSubstr("none.clf"));
  const auto folder = read_carmen_log(dir_.str());
  ASSERT_FALSE(folder.has_value());
  EXPECT_THAT(folder.error().message, HasSubstr("found a directory"));
}

TEST_F(CarmenLogTest, SortsAnyOrderAndCountsItsInversions) {
  EXPECT_TRUE(rc::check([this](const std::vector<std::uint16_t>& stamps) {
    RC_PRE(!stamps.empty());
    std::string text;
    int inversions = 0;
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      text += "FLASER 2 1 2 0 0 0 0 0 0 " + std::to_string(stamps[i]) + " h 0\n";
      inversions += i > 0 && stamps[i] < stamps[i - 1] ? 1 : 0;
    }
    const auto log = read_carmen_log(dir_.write("p.clf", text), kFewBeams);
    RC_ASSERT(log.has_value());
    RC_ASSERT(log->scans.size() == stamps.size());
    RC_ASSERT(log->stamp_inversions == inversions);
    for (std::size_t i = 1; i < log->scans.size(); ++i)
      RC_ASSERT(log->scans[i - 1].stamp_s <= log->scans[i].stamp_s);
  }));
}

}  // namespace
}  // namespace topo::bench

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
using testing::gzip;
using ::testing::HasSubstr;
using testing::kSampleLog;
using types::Errc;

class CarmenLogTest : public ::testing::Test {
 protected:
  void expect_error(const std::string& content, const std::string& text) {
    const auto log = read_carmen_log(dir_.write("bad.clf", content));
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
  const auto log = read_carmen_log(dir_.write("a.clf", kSampleLog));
  ASSERT_TRUE(log.has_value()) << log.error().message;
  expect_sample(*log);
}

TEST_F(CarmenLogTest, ReadsBothPackingsAlsoInSeveralMembers) {
  const std::string head = kSampleLog.substr(0, 100), tail = kSampleLog.substr(100);
  for (const std::string& packed :
       {bzip2(kSampleLog), gzip(kSampleLog), bzip2(head) + bzip2(tail), gzip(head) + gzip(tail)}) {
    const auto log = read_carmen_log(dir_.write("a.clf.packed", packed));
    ASSERT_TRUE(log.has_value()) << log.error().message;
    expect_sample(*log);
  }
}

TEST_F(CarmenLogTest, KnowsTheAnglesOfTheUsualBeamCounts) {
  struct Case {
    int beams;
    double start_deg, step_deg;
  };
  for (const Case c : {Case{180, -90, 1}, Case{181, -90, 1}, Case{360, -90, 0.5}, Case{361, -90, 0.5},
                       Case{401, -50, 0.25}}) {
    std::string line = "FLASER " + std::to_string(c.beams);
    for (int i = 0; i < c.beams; ++i) line += " 1.0";
    const auto log = read_carmen_log(dir_.write("a.clf", line + " 0 0 0 0 0 0 1.0 h 1.0\n"));
    ASSERT_TRUE(log.has_value()) << log.error().message;
    EXPECT_NEAR(log->scans[0].angle_min_rad, c.start_deg * types::kDegree_rad, 1e-6) << c.beams;
    EXPECT_NEAR(log->scans[0].angle_increment_rad, c.step_deg * types::kDegree_rad, 1e-6) << c.beams;
  }
}

TEST_F(CarmenLogTest, ReadsRobotLaserWithItsOwnAnglesAndReach) {
  const auto log = read_carmen_log(dir_.write("a.clf",
                                              "ROBOTLASER1 0 -1.57 3.14 0.0174 50.0 0.01 0 3 1 2 51 2 9 9 1 "
                                              "2 0.1 3 4 0.2 0.5 0.1 0.3 0.2 1e6 7.5 host 0.1\n"
                                              "FLASER 2 1 2 0 0 0 0 0 0 7.5 host 0.1\n"));
  ASSERT_TRUE(log.has_value()) << log.error().message;
  ASSERT_EQ(log->scans.size(), 1U);
  EXPECT_EQ(log->flaser_ignored, 1);
  EXPECT_FLOAT_EQ(log->scans[0].angle_min_rad, -1.57F);
  EXPECT_FLOAT_EQ(log->scans[0].angle_increment_rad, 0.0174F);
  EXPECT_THAT(log->scans[0].range_m, ::testing::ElementsAre(1.0F, 2.0F, types::kNoReturn));
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
      "message name");
  expect_error(kSampleLog.substr(0, kSampleLog.size() - 20),
               ":5: found 12 words in a last line without end (truncated file)");
  expect_error(std::string(3U << 20U, 'A'), "a line of more than");
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
    const auto log = read_carmen_log(dir_.write("p.clf", text));
    RC_ASSERT(log.has_value());
    RC_ASSERT(log->scans.size() == stamps.size());
    RC_ASSERT(log->stamp_inversions == inversions);
    for (std::size_t i = 1; i < log->scans.size(); ++i)
      RC_ASSERT(log->scans[i - 1].stamp_s <= log->scans[i].stamp_s);
  }));
}

}  // namespace
}  // namespace topo::bench

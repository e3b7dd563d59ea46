// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Against the real logs, whose figures their MANIFEST states. They are not part of the tree.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/bench/carmen/carmen_log.hpp"
#include "tests/bench/carmen/relations.hpp"

namespace topo::bench {
namespace {

class CarmenDataTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("TOPOMETRIC_DATA");
    if (folder == nullptr || *folder == '\0')
      GTEST_SKIP() << "skipped: TOPOMETRIC_DATA does not name the folder of the real logs";
    data_ = folder;
  }
  std::string data_;
};

struct Expected {
  const char* name;
  std::size_t scans, beams, odometry;
  int relations;
  double trans_mean_m, trans_std_m, rot_mean_deg, rot_std_deg;
};

TEST_F(CarmenDataTest, RawOdometryHasTheKnownErrors) {
  for (const Expected& e : {Expected{"intel", 13631, 180, 26915, 2984, 7.3702, 14.3491, 39.166, 53.791},
                            Expected{"fr079", 4934, 360, 8951, 1685, 6.5042, 13.6640, 30.292, 45.520}}) {
    const auto log = read_carmen_log(data_ + "/slam_logs/" + e.name + ".clf.bz2");
    ASSERT_TRUE(log.has_value()) << log.error().message;
    EXPECT_EQ(log->scans.size(), e.scans);
    EXPECT_EQ(log->scans.front().range_m.size(), e.beams);
    EXPECT_EQ(log->odometry.size(), e.odometry);
    const auto relations = read_relations(data_ + "/relations/" + e.name + ".relations.bz2");
    ASSERT_TRUE(relations.has_value()) << relations.error().message;
    std::vector<TimedPose> robot;
    for (const CarmenScan& scan : log->scans) robot.push_back({scan.stamp_s, scan.robot_odom});
    const RelationErrors errors = evaluate_relations(*relations, robot);
    EXPECT_EQ(errors.used, e.relations);
    EXPECT_EQ(errors.skipped, 0);
    EXPECT_NEAR(errors.trans_mean_m, e.trans_mean_m, 5e-5) << e.name;
    EXPECT_NEAR(errors.trans_std_m, e.trans_std_m, 5e-5) << e.name;
    EXPECT_NEAR(errors.rot_mean_rad / types::kDegree_rad, e.rot_mean_deg, 5e-4) << e.name;
    EXPECT_NEAR(errors.rot_std_rad / types::kDegree_rad, e.rot_std_deg, 5e-4) << e.name;
  }
}

TEST_F(CarmenDataTest, ReadsTheOtherLogs) {
  struct Case {
    const char* name;
    std::size_t scans;
  };
  for (const Case& c :
       {Case{"mit-csail.clf.bz2", 1988}, Case{"radish/belgioioso.odom.clf.gz", 395},
        Case{"radish/freiburg-101.odom.clf.gz", 292}, Case{"radish/seattle.odom.clf.gz", 241}}) {
    const auto log = read_carmen_log(data_ + "/slam_logs/" + c.name);
    ASSERT_TRUE(log.has_value()) << log.error().message;
    EXPECT_EQ(log->scans.size(), c.scans) << c.name;
  }
  for (const Case& c : {Case{"exp1", 756}, Case{"exp2", 641}}) {
    const auto log = read_mines_log(data_ + "/slam_logs/mines_urg/" + c.name + ".dat.bz2");
    ASSERT_TRUE(log.has_value()) << log.error().message;
    EXPECT_EQ(log->scans.size(), c.scans) << c.name;
    EXPECT_NEAR(log->scans.back().stamp_s - log->scans.front().stamp_s, 60.0, 20.0) << c.name;
  }
}

TEST_F(CarmenDataTest, RefusesAMinesLogOfAnotherLayoutByItsColumns) {
  const auto log = read_mines_log(data_ + "/slam_logs/mines_urg/test_lab.dat.bz2");
  ASSERT_FALSE(log.has_value());
  EXPECT_NE(log.error().message.find(":1: found 695 columns, expected 706"), std::string::npos)
      << log.error().message;
}

}  // namespace
}  // namespace topo::bench

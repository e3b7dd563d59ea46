// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/slam_report.hpp"

#include <gmock/gmock.h>

namespace topo::bench {
namespace {

MappingRun run_of(std::size_t scans, int lost) {
  MappingRun run;
  run.trajectory.resize(scans);
  run.lost = lost;
  return run;
}

TEST(SlamReport, DoubtsAMapOfLostScans) {
  EXPECT_THAT(doubt_of(run_of(1006, 1005)), ::testing::HasSubstr("lost in 1005 of 1006 scans"));
  EXPECT_NE(doubt_of(run_of(100, 11)), "");
  EXPECT_EQ(doubt_of(run_of(100, 10)), "");
  EXPECT_EQ(doubt_of(run_of(1, 0)), "");
}

}  // namespace
}  // namespace topo::bench

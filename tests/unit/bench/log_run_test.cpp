// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/log_run.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

TEST(LogRun, PutsTheLastBeamOfASlowSweepAtTheStamp) {
  CarmenScan from;
  from.range_m.assign(101, 2.0F);
  from.time_increment_s = 1e-3F;
  types::Scan scan;
  fill_scan(from, 5.0, 7, scan);
  EXPECT_EQ(scan.sequence, 7U);
  EXPECT_EQ(scan.arrival, types::stamp_from_seconds(5.0));
  EXPECT_NEAR(types::to_seconds(scan.arrival - scan.first_beam), 0.1, 1e-6);
  EXPECT_FLOAT_EQ(scan.geometry.time_increment_s, 1e-3F);
  from.time_increment_s = 0.0F;
  fill_scan(from, 5.0, 8, scan);
  EXPECT_EQ(scan.first_beam, scan.arrival);
}

}  // namespace
}  // namespace topo::bench

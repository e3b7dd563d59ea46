// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/thinned_log.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

CarmenLog log_of(int scans) {
  CarmenLog log;
  for (int i = 0; i < scans; ++i) {
    log.scans.emplace_back();
    log.scans.back().stamp_s = 1e9 + 0.2 * i;
  }
  return log;
}

TEST(ThinnedLog, EveryThirdScanIsKeptFromTheFirstOn) {
  CarmenLog log = log_of(10);
  thin(log, {3, 0.0, 1});
  ASSERT_EQ(log.scans.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(log.scans[i].stamp_s, 1e9 + 0.2 * static_cast<double>(3 * i));
}

TEST(ThinnedLog, AShareIsDroppedBySeed) {
  CarmenLog a = log_of(2000), b = log_of(2000), c = log_of(2000);
  thin(a, {1, 0.3, 5});
  thin(b, {1, 0.3, 5});
  thin(c, {1, 0.3, 6});
  EXPECT_NEAR(static_cast<double>(a.scans.size()), 1400.0, 80.0);
  const auto same = [](const CarmenLog& x, const CarmenLog& y) {
    return std::equal(x.scans.begin(), x.scans.end(), y.scans.begin(), y.scans.end(),
                      [](const CarmenScan& p, const CarmenScan& q) { return p.stamp_s == q.stamp_s; });
  };
  EXPECT_TRUE(same(a, b));
  EXPECT_FALSE(same(a, c));
  EXPECT_EQ(a.scans.front().stamp_s, 1e9);
}

TEST(ThinnedLog, RelationsOfScansThatAreGoneAreNoMeasure) {
  CarmenLog log = log_of(4);
  const std::vector<Relation> all{{1e9, 1e9 + 0.4, {}}, {1e9, 1e9 + 0.2, {}}, {1e9 + 0.4, 1e9 + 0.399, {}}};
  thin(log, {2, 0.0, 1});
  const std::vector<Relation> left = between_scans(all, log);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].t2_s, 1e9 + 0.4);
}

}  // namespace
}  // namespace topo::bench

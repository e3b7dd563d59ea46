// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/sync/histogram.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

namespace topo::sync {
namespace {

TEST(Histogram, EmptyOneReportsZeros) {
  const Histogram h;
  const LatencySummary s = h.summary();
  EXPECT_EQ(s.count, 0U);
  EXPECT_EQ(s.p50_ns, 0);
  EXPECT_EQ(s.p999_ns, 0);
  EXPECT_EQ(s.max_ns, 0);
  EXPECT_EQ(s.mean_ns, 0.0);
}

TEST(Histogram, SmallValuesAreExact) {
  Histogram h;
  for (int i = 0; i < 32; ++i) h.record(i);
  EXPECT_EQ(h.quantile_ns(0.5), 15);
  EXPECT_EQ(h.quantile_ns(1.0), 31);
  EXPECT_EQ(h.quantile_ns(0.0), 0);
  EXPECT_DOUBLE_EQ(h.mean_ns(), 15.5);
}

TEST(Histogram, QuantilesAreAtMost3Point2PercentAboveTheTruth) {
  EXPECT_TRUE(rc::check([] {
    const double exponent_max = *rc::gen::inRange(1, 36);
    const auto raw = *rc::gen::nonEmpty(
        rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>()));
    Histogram h;
    std::vector<std::int64_t> values;
    for (const std::uint32_t r : raw) {
      values.push_back(
          static_cast<std::int64_t>(std::exp2(exponent_max * static_cast<double>(r) / 4294967296.0)));
      h.record(values.back());
    }
    std::sort(values.begin(), values.end());
    for (const double q : {0.01, 0.5, 0.9, 0.99, 0.999, 1.0}) {
      const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
      const std::int64_t truth = values[std::max<std::size_t>(rank, 1) - 1];
      const std::int64_t found = h.quantile_ns(q);
      RC_ASSERT(found >= truth);
      RC_ASSERT(static_cast<double>(found) <= 1.032 * static_cast<double>(truth));
    }
    RC_ASSERT(h.max_ns() == values.back());
    RC_ASSERT(h.count() == values.size());
  }));
}

TEST(Histogram, TailShowsInP999) {
  Histogram h;
  for (int i = 0; i < 9980; ++i) h.record(50'000);
  for (int i = 0; i < 20; ++i) h.record(3'000'000);
  const LatencySummary s = h.summary();
  EXPECT_NEAR(static_cast<double>(s.p50_ns), 50e3, 1.6e3);
  EXPECT_NEAR(static_cast<double>(s.p99_ns), 50e3, 1.6e3);
  EXPECT_NEAR(static_cast<double>(s.p999_ns), 3e6, 0.1e6);
}

TEST(Histogram, TakesNegativeAndEndlessDurations) {
  Histogram h;
  h.record(-5);
  EXPECT_EQ(h.max_ns(), 0);
  EXPECT_EQ(h.quantile_ns(0.5), 0);
  h.record(std::int64_t{1} << 36);
  h.record(INT64_MAX);
  EXPECT_EQ(h.count(), 3U);
  EXPECT_EQ(h.quantile_ns(1.0), INT64_MAX);
}

}  // namespace
}  // namespace topo::sync

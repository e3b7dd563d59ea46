// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/paired_ratio.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <vector>

namespace topo::bench {
namespace {

TEST(Student, isAsInPrintedTables) {
  // Two-sided 95 % points of Student's t, as every book of statistics has them.
  EXPECT_NEAR(student_95(1), 12.7062, 5e-5);
  EXPECT_NEAR(student_95(2), 4.30265, 5e-6);
  EXPECT_NEAR(student_95(3), 3.18245, 5e-6);
  EXPECT_NEAR(student_95(4), 2.77645, 5e-6);
  EXPECT_NEAR(student_95(5), 2.57058, 5e-6);
  EXPECT_NEAR(student_95(10), 2.22814, 5e-6);
  EXPECT_NEAR(student_95(30), 2.04227, 5e-6);
  EXPECT_NEAR(student_95(120), 1.97993, 5e-6);
  EXPECT_NEAR(student_95(1000000), 1.959964, 5e-6) << "the normal distribution's";
}

TEST(PairedRatio, ofTwoPairsByHand) {
  // Ratios 2 and 8: logarithms 1 and 3 in units of ln 2. Mean 2, deviation sqrt(2), of the mean 1; one degree
  // of freedom.
  const std::vector<Pair> pairs{{"office", 20.0, 10.0}, {"office", 8.0, 1.0}};
  const PairedRatio r = paired_ratio(pairs);
  EXPECT_EQ(r.pairs, 2U);
  EXPECT_EQ(r.worlds, 1U);
  EXPECT_EQ(r.a_less, 0U);
  EXPECT_NEAR(r.ratio, 4.0, 1e-12);
  EXPECT_NEAR(r.over_runs.low, 4.0 * std::exp2(-12.7062), 1e-6);
  EXPECT_NEAR(r.over_runs.high, 4.0 * std::exp2(12.7062), 4.0);
  EXPECT_EQ(r.over_worlds.low, 0.0) << "one building says nothing of others";
  EXPECT_TRUE(std::isinf(r.over_worlds.high));
  EXPECT_TRUE(std::isinf(r.bootstrap.high));
}

TEST(PairedRatio, ofTwoWorldsByHand) {
  // Logarithms in units of ln 2: 1 and 3 in one building, -1 and 1 in the other.
  const std::vector<Pair> pairs{{"b", 1.0, 2.0}, {"a", 2.0, 1.0}, {"b", 6.0, 3.0}, {"a", 8.0, 1.0}};
  const PairedRatio r = paired_ratio(pairs);
  EXPECT_EQ(r.worlds, 2U);
  EXPECT_EQ(r.a_less, 1U);
  EXPECT_NEAR(r.ratio, 2.0, 1e-12);
  // Over runs: squares 0, 4, 4, 0 around the mean 1; variance 8/3, of the mean 2/3; three degrees of freedom.
  const double runs = 3.182446 * std::sqrt(2.0 / 3.0);
  EXPECT_NEAR(r.over_runs.low, std::exp2(1.0 - runs), 1e-5);
  EXPECT_NEAR(r.over_runs.high, std::exp2(1.0 + runs), 1e-4);
  // Over worlds: means 2 and 0; of their mean the variance is 2/2; one degree of freedom.
  EXPECT_NEAR(r.over_worlds.low, std::exp2(1.0 - 12.7062), 1e-6);
  EXPECT_NEAR(r.over_worlds.high / std::exp2(1.0 + 12.7062), 1.0, 1e-4);
}

TEST(PairedRatio, ofEqualsIsOneWithoutSpread) {
  const PairedRatio r = paired_ratio(std::vector<Pair>{{"a", 3.0, 3.0}, {"b", 5.0, 5.0}, {"b", 7.0, 7.0}});
  EXPECT_EQ(r.ratio, 1.0);
  EXPECT_EQ(r.over_runs.low, 1.0);
  EXPECT_EQ(r.over_worlds.high, 1.0);
  EXPECT_EQ(r.bootstrap.high, 1.0);
}

TEST(PairedRatio, ofNothingSaysNothing) {
  const PairedRatio r = paired_ratio({});
  EXPECT_EQ(r.pairs, 0U);
  EXPECT_EQ(r.ratio, 1.0);
  EXPECT_TRUE(std::isinf(r.over_runs.high));
}

TEST(PairedRatio, turnsRoundWithItsSidesAndScalesWithTheirs) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Pair> pairs, other_way, scaled;
    const double factor = 0.01 * *rc::gen::inRange(10, 1000);
    const int size = *rc::gen::inRange(2, 30);
    for (int i = 0; i < size; ++i) {
      const Pair pair{std::to_string(i % 3), 0.1 * *rc::gen::inRange(10, 36000),
                      0.1 * *rc::gen::inRange(10, 36000)};
      pairs.push_back(pair);
      other_way.push_back({pair.world, pair.b, pair.a});
      scaled.push_back({pair.world, factor * pair.a, pair.b});
    }
    const PairedRatio r = paired_ratio(pairs), turned = paired_ratio(other_way), s = paired_ratio(scaled);
    const auto near = [](double a, double b) { return std::abs(a / b - 1.0) < 1e-6; };
    RC_ASSERT(near(r.ratio * turned.ratio, 1.0));
    RC_ASSERT(near(r.over_runs.low * turned.over_runs.high, 1.0));
    RC_ASSERT(near(s.ratio, factor * r.ratio));
    RC_ASSERT(near(s.over_runs.low, factor * r.over_runs.low));
    RC_ASSERT(r.over_runs.low <= r.ratio * (1.0 + 1e-9) && r.ratio <= r.over_runs.high * (1.0 + 1e-9));
  }));
}

}  // namespace
}  // namespace topo::bench

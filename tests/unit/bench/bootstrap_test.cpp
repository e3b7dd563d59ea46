// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/bootstrap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sim/random.hpp"

namespace topo::bench {
namespace {

TEST(Bootstrap, saysNothingOfOneBuilding) {
  const std::vector<double> one{0.3};
  EXPECT_DOUBLE_EQ(bootstrap_95(one).low, 0.0);
  EXPECT_TRUE(std::isinf(bootstrap_95(one).high));
}

TEST(Bootstrap, isThePointWhereAllAreAlike) {
  const std::vector<double> alike(7, std::log(0.8));
  EXPECT_NEAR(bootstrap_95(alike).low, 0.8, 1e-12);
  EXPECT_NEAR(bootstrap_95(alike).high, 0.8, 1e-12);
}

TEST(Bootstrap, isTheSameForTheSameValues) {
  const std::vector<double> values{0.1, -0.4, 0.2, 0.0};
  EXPECT_EQ(bootstrap_95(values).low, bootstrap_95(values).low);
  EXPECT_EQ(bootstrap_95(values).high, bootstrap_95(values).high);
}

/// Of many values the interval of their mean is that of the normal law: 1.96 deviations over the root of n.
TEST(Bootstrap, comesNearToTheNormalLaw) {
  sim::Random random(3);
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) values.push_back(0.5 * random.gaussian());
  const Interval interval = bootstrap_95(values);
  EXPECT_NEAR(std::log(interval.high / interval.low), 2.0 * 1.96 * 0.5 / 20.0, 0.01);
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/extent.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/unit/core/walls/points.hpp"

namespace topo::compass {
namespace {

using walls::Points;

double sum_of(const types::Vector2& p) { return p.x() + p.y(); }

TEST(Extent, OfNoPointsIsEmptyAndOfOneIsItsValue) {
  const Extent none = extent_of({}, sum_of);
  EXPECT_GT(none.low, none.high);
  const auto is = [](const Extent& extent, double low, double high) {
    return extent.low == low && extent.high == high;
  };
  EXPECT_TRUE(is(extent_of(Points{{2.0, -5.0}}, sum_of), -3.0, -3.0));
  EXPECT_TRUE(is(extent_of(Points{{1.0, 1.0}, {4.0, 0.0}, {-2.0, 0.5}}, sum_of), -1.5, 4.0));
}

TEST(Extent, DoesNotDependOnTheOrderAndHoldsAllValues) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 3.0);
  Extent ahead, back;
  std::vector<double> values(100);
  for (double& value : values) value = normal(random);
  for (std::size_t i = 0; i < values.size(); ++i) {
    ahead.add(values[i]);
    back.add(values[values.size() - 1 - i]);
  }
  EXPECT_EQ(ahead.low, back.low);
  EXPECT_EQ(ahead.high, back.high);
  for (const double value : values) EXPECT_TRUE(ahead.low <= value && value <= ahead.high);
}

}  // namespace
}  // namespace topo::compass

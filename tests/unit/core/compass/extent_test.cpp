// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/extent.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <random>
#include <vector>

#include "tests/unit/core/walls/points.hpp"

namespace topo::compass {
namespace {

using walls::Points;

double sum_of(const types::Vector2& p) { return p.x() + p.y(); }

TEST(Extent, OfPointsThatCameAndWentIsThatOfThosePresent) {
  EXPECT_TRUE(rc::check([] {
    Points before;
    Extent extent;
    for (int step = 0; step < 8; ++step) {
      Points points = before;
      const double gone = *rc::gen::inRange(0, 12);
      std::erase_if(points, [&](const types::Vector2& p) { return sum_of(p) == gone; });
      for (int k = *rc::gen::inRange(0, 4); k > 0; --k)
        points.emplace_back(*rc::gen::inRange(0, 6), *rc::gen::inRange(0, 6));
      extent = renewed(extent, points_change(before, points), sum_of);
      RC_ASSERT(extent == extent_of(points, sum_of));
      before = points;
    }
  }));
}

TEST(Extent, LooksAtAllPointsOnlyWhenOneAtAnEndGoes) {
  const Points all{{0, 0}, {1, 0}, {2, 0}, {5, 0}};
  int looks = 0;
  const auto counted = [&](const types::Vector2& p) {
    ++looks;
    return p.x();
  };
  const Extent inner = renewed({0.0, 5.0}, {all, {{2, 0}}, {{3, 0}}}, counted);
  EXPECT_EQ(inner, (Extent{0.0, 5.0}));
  EXPECT_EQ(looks, 2);
  const Extent end = renewed({0.0, 7.0}, {all, {}, {{7, 0}}}, counted);
  EXPECT_EQ(end, (Extent{0.0, 5.0}));
}

TEST(Extent, OfNoPointsIsEmptyAndOfOneIsItsValue) {
  const Extent none = extent_of({}, sum_of);
  EXPECT_GT(none.low, none.high);
  EXPECT_EQ(extent_of(Points{{2.0, -5.0}}, sum_of), (Extent{-3.0, -3.0}));
  const Points points{{1.0, 1.0}, {4.0, 0.0}, {-2.0, 0.5}};
  EXPECT_EQ(extent_of(points, sum_of), (Extent{-1.5, 4.0}));
  EXPECT_EQ(renewed(none, {points, points, {}}, sum_of), (Extent{-1.5, 4.0}));
  EXPECT_EQ(renewed({-1.5, 4.0}, {{}, {}, points}, sum_of), none) << "all are gone";
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
  EXPECT_EQ(ahead, back);
  for (const double value : values) EXPECT_TRUE(ahead.low <= value && value <= ahead.high);
}

}  // namespace
}  // namespace topo::compass

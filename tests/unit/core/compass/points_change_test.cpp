// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/points_change.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "tests/unit/core/walls/points.hpp"

namespace topo::compass {
namespace {

using walls::Points;

Points sorted(Points points) {
  std::sort(points.begin(), points.end(), comes_before);
  return points;
}

Points any_points() {
  Points points;
  for (int k = *rc::gen::inRange(0, 30); k > 0; --k)
    points.emplace_back(*rc::gen::inRange(0, 5), *rc::gen::inRange(0, 5));
  return points;
}

TEST(PointsChange, LeadsFromThoseBeforeToThoseNow) {
  EXPECT_TRUE(rc::check([] {
    const Points before = any_points(), now = any_points();
    const PointsChange change = points_change(before, now);
    Points left = before, right = now;
    left.insert(left.end(), change.come.begin(), change.come.end());
    right.insert(right.end(), change.gone.begin(), change.gone.end());
    RC_ASSERT(sorted(left) == sorted(right));
    RC_ASSERT(change.now.data() == now.data());
  }));
}

TEST(PointsChange, RowByRowIsNoMoreThanTheDifference) {
  const Points before{{0, 0}, {2, 0}, {1, 1}, {1, 2}}, now{{0, 0}, {1, 0}, {1, 1}, {0, 2}};
  const PointsChange change = points_change(before, now);
  EXPECT_EQ(change.come, (Points{{1, 0}, {0, 2}}));
  EXPECT_EQ(change.gone, (Points{{2, 0}, {1, 2}}));
}

TEST(PointsChange, OfSortedPointsIsTheDifferenceOfTheSets) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const auto some = [&] {
      Points points;
      for (std::size_t k = random() % 30; k > 0; --k) {
        const double x = static_cast<double>(random() % 6), y = static_cast<double>(random() % 6);
        points.emplace_back(x, y);
      }
      points = sorted(std::move(points));
      points.erase(std::unique(points.begin(), points.end()), points.end());
      return points;
    };
    const Points before = some(), now = some();
    Points come, gone;
    std::ranges::set_difference(now, before, std::back_inserter(come), comes_before);
    std::ranges::set_difference(before, now, std::back_inserter(gone), comes_before);
    const PointsChange change = points_change(before, now);
    EXPECT_EQ(change.come, come) << seed;
    EXPECT_EQ(change.gone, gone) << seed;
    EXPECT_TRUE(points_change(now, now).come.empty() && points_change(now, now).gone.empty());
    EXPECT_EQ(points_change({}, now).come, now);
    EXPECT_EQ(points_change(before, {}).gone, before);
  }
}

}  // namespace
}  // namespace topo::compass

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/points_change.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

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

}  // namespace
}  // namespace topo::compass

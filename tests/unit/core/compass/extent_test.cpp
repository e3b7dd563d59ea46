// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/extent.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

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

}  // namespace
}  // namespace topo::compass

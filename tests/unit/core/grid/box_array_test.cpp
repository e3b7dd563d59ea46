// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/box_array.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <numeric>

namespace topo::grid {
namespace {

std::size_t place_in_box(const CellBox& box, CellIndex c) {
  return static_cast<std::size_t>((c.y - box.min.y) * box.width() + c.x - box.min.x);
}

TEST(BoxArray, KeepsEachValueAtItsCellAndFillsTheRest) {
  EXPECT_TRUE(rc::check([] {
    const auto any = [](int low, int high) { return *rc::gen::inRange(low, high); };
    const CellIndex min{any(-30, 30), any(-30, 30)};
    const CellBox box{min, {min.x + any(0, 12), min.y + any(0, 12)}};
    const CellBox to{{box.min.x - any(0, 5), box.min.y - any(0, 5)},
                     {box.max.x + any(0, 5), box.max.y + any(0, 5)}};
    std::vector<int> values(static_cast<std::size_t>(box.width() * box.height()));
    std::iota(values.begin(), values.end(), 1);
    const std::vector<int> wide = over_box(values, box, to);
    RC_ASSERT(wide.size() == static_cast<std::size_t>(to.width() * to.height()));
    for (int y = to.min.y; y <= to.max.y; ++y) {
      for (int x = to.min.x; x <= to.max.x; ++x) {
        const bool inside = x >= box.min.x && x <= box.max.x && y >= box.min.y && y <= box.max.y;
        RC_ASSERT(wide[place_in_box(to, {x, y})] == (inside ? values[place_in_box(box, {x, y})] : 0));
      }
    }
  }));
}

TEST(BoxArray, OfAnEmptyBoxIsAllNew) {
  const std::vector<int> wide = over_box(std::vector<int>{}, CellBox{}, CellBox{{2, 3}, {4, 5}});
  EXPECT_EQ(wide, std::vector<int>(9, 0));
}

TEST(CellBox, IsTheSmallestAroundItsCells) {
  EXPECT_TRUE(rc::check([] {
    CellBox box;
    RC_ASSERT(box.empty());
    RC_ASSERT(box.width() == 0);
    RC_ASSERT(box.height() == 0);
    std::vector<int> xs, ys;
    for (int cells = *rc::gen::inRange(1, 8); cells > 0; --cells) {
      xs.push_back(*rc::gen::arbitrary<std::int32_t>());
      ys.push_back(*rc::gen::arbitrary<std::int32_t>());
      box.extend({xs.back(), ys.back()});
    }
    const auto [left, right] = std::minmax_element(xs.begin(), xs.end());
    const auto [low, high] = std::minmax_element(ys.begin(), ys.end());
    RC_ASSERT(box == (CellBox{{*left, *low}, {*right, *high}}));
    RC_ASSERT(!box.empty());
    RC_ASSERT(box.width() == std::int64_t{*right} - *left + 1);
    RC_ASSERT(box.height() == std::int64_t{*high} - *low + 1);
  }));
}

TEST(CellBox, IsEmptyWhenEitherSideIs) {
  EXPECT_TRUE((CellBox{{0, 1}, {5, 0}}).empty());
  EXPECT_TRUE((CellBox{{1, 0}, {0, 5}}).empty());
  EXPECT_EQ((CellBox{{1, 0}, {0, 5}}).height(), 0);
  EXPECT_EQ((CellBox{{INT32_MIN, 0}, {INT32_MAX, 0}}).width(), std::int64_t{1} << 32);
}

}  // namespace
}  // namespace topo::grid

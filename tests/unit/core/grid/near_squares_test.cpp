// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/near_squares.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/grid/column_steps.hpp"

namespace topo::grid {
namespace {

TEST(NearSquares, AreTheLeastOverAllColumnsWhileSmall) {
  EXPECT_TRUE(rc::check([] {
    const std::vector<Steps> row = any_column_steps(500);
    const bool open_outside = *rc::gen::arbitrary<bool>();
    NearSquares near(row.size(), open_outside);
    near.take(row.data(), 0, row.size());
    for (std::size_t first = 0; first < row.size(); first += NearSquares::kBlock) {
      const NearSquares::Block block = near.of_block(first);
      for (std::size_t i = first; i < std::min(row.size(), first + NearSquares::kBlock); ++i) {
        const std::int64_t square = least_square(row, i, open_outside);
        const std::int16_t found = block[i - first];
        if (square < NearSquares::kFar)
          RC_ASSERT(found == square);
        else
          RC_ASSERT(found >= NearSquares::kFar);
      }
    }
  }));
}

TEST(NearSquares, OfAPartOfTheRowAreThoseOfTheWhole) {
  EXPECT_TRUE(rc::check([] {
    const std::vector<Steps> row = any_column_steps(400), other = any_column_steps(400);
    NearSquares near(row.size(), true), whole(row.size(), true);
    // What is left of another row has no effect.
    if (other.size() >= row.size()) near.take(other.data(), 0, row.size());
    const auto from = *rc::gen::inRange<std::size_t>(0, row.size());
    const auto end = *rc::gen::inRange<std::size_t>(from + 1, row.size() + 1);
    near.take(row.data(), from, end);
    whole.take(row.data(), 0, row.size());
    for (std::size_t first = from; first < end; first += NearSquares::kBlock) {
      const NearSquares::Block a = near.of_block(first), b = whole.of_block(first);
      const std::size_t count = std::min(end - first, NearSquares::kBlock);
      RC_ASSERT(std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(count), b.begin()));
    }
  }));
}

TEST(NearSquares, OneColumnIsExactAsFarAsASquareFits) {
  for (Steps steps = 0; steps < 200; ++steps) {
    NearSquares near(1, true);
    near.take(&steps, 0, 1);
    EXPECT_EQ(near.of_block(0).front(), std::min<int>(steps > 127 ? NearSquares::kFar : steps * steps, 16383))
        << steps;
  }
}

TEST(NearSquares, TheGreatestIsThatOfAllTheBlock) {
  for (std::size_t i = 0; i < NearSquares::kBlock; ++i) {
    NearSquares::Block block{};
    EXPECT_EQ(NearSquares::greatest(block), 0);
    block[i] = 7;
    block[(i + 5) % block.size()] = 3;
    EXPECT_EQ(NearSquares::greatest(block), 7) << i;
  }
}

}  // namespace
}  // namespace topo::grid

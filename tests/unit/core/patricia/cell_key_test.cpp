// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/patricia/cell_key.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

#include "tests/unit/core/patricia/model.hpp"

namespace topo::patricia {
namespace {

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();

TEST(CellKey, HasXInTheEvenBitsAndNegativeBeforePositive) {
  static_assert(cell_key(kMin, kMin) == 0);
  static_assert(cell_key(kMin + 1, kMin) == 1);
  static_assert(cell_key(kMin, kMin + 1) == 2);
  static_assert(cell_key(kMax, kMax) == ~Key{0});
  EXPECT_EQ(cell_key(0, 0), 0xC000000000000000U);
  EXPECT_LT(cell_key(-1, -1), cell_key(0, 0));
}

TEST(CellKey, ComesBackAsTheSameCell) {
  EXPECT_TRUE(rc::check([](std::int32_t x, std::int32_t y) {
    RC_ASSERT(cell_of(cell_key(x, y)) == (Cell{x, y}));
  }));
  for (const std::int32_t x : {kMin, -1, 0, 1, kMax}) {
    EXPECT_EQ(cell_of(cell_key(x, kMax)), (Cell{x, kMax}));
    EXPECT_EQ(cell_of(cell_key(kMin, x)), (Cell{kMin, x}));
  }
}

TEST(CellKey, IsTheBitsTakenInTurn) {
  EXPECT_TRUE(rc::check([](std::int32_t x, std::int32_t y) {
    Key expected = 0;
    const auto ux = static_cast<std::uint32_t>(x) ^ 0x80000000U;
    const auto uy = static_cast<std::uint32_t>(y) ^ 0x80000000U;
    for (unsigned bit = 0; bit < 32; ++bit) {
      expected |= Key{(ux >> bit) & 1U} << (2 * bit);
      expected |= Key{(uy >> bit) & 1U} << (2 * bit + 1);
    }
    RC_ASSERT(cell_key(x, y) == expected);
  }));
}

TEST(CellKey, KeepsTheOrderOfEachCoordinateWhenMasked) {
  EXPECT_TRUE(rc::check([](std::int32_t x1, std::int32_t y1, std::int32_t x2, std::int32_t y2) {
    const Key a = cell_key(x1, y1);
    const Key b = cell_key(x2, y2);
    RC_ASSERT(((a & kKeyBitsX) < (b & kKeyBitsX)) == (x1 < x2));
    RC_ASSERT(((a & kKeyBitsY) < (b & kKeyBitsY)) == (y1 < y2));
  }));
}

TEST(CellKey, PutsAnAlignedSquareIntoOneRangeOfKeys) {
  // Cells -16..-1 by 32..47: a square of 16, aligned to 16.
  const Key first = cell_key(-16, 32);
  const Key last = cell_key(-1, 47);
  EXPECT_EQ(last - first, 255U);
  for (std::int32_t x = -20; x < 4; ++x) {
    for (std::int32_t y = 28; y < 52; ++y) {
      const bool inside = CellWindow{{-16, 32}, {-1, 47}}.contains({x, y});
      EXPECT_EQ(cell_key(x, y) >= first && cell_key(x, y) <= last, inside);
    }
  }
}

TEST(Split, PartsTwoKeysAtTheirHighestDifferentBit) {
  EXPECT_TRUE(rc::check([] {
    const Key a = *testing::any_key();
    const Key b = *testing::any_key();
    RC_PRE(a != b);
    const Key split = split_of(a, b);
    RC_ASSERT(split == split_of(b, a));
    RC_ASSERT(belongs_below(a, split));
    RC_ASSERT(belongs_below(b, split));
    RC_ASSERT(side_of(a, split) == (a < b ? 0U : 1U));
    RC_ASSERT(side_of(b, split) == (a < b ? 1U : 0U));
    RC_ASSERT(first_below(split) <= std::min(a, b));
    RC_ASSERT(last_below(split) >= std::max(a, b));
  }));
}

}  // namespace
}  // namespace topo::patricia

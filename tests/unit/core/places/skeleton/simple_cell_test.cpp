// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/simple_cell.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <utility>

#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::places {
namespace {

using grid::CellState;

/// Components and holes of the free cells.
std::pair<int, int> free_topology(const grid::DenseMap& map) {
  return {count_components(map, true, [&](std::size_t i) { return map.cells[i] == CellState::kFree; }),
          count_components(map, false, [&](std::size_t i) { return map.cells[i] != CellState::kFree; })};
}

TEST(SimpleCell, IsOneWithoutWhichComponentsAndHolesAreTheSame) {
  EXPECT_TRUE(rc::check([] {
    DrawnMap drawn(7, 7);
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 7; ++x)
        if (*rc::gen::inRange(0, 2) == 0) drawn.free(x, y, x + 1, y + 1);
    drawn.free(3, 3, 4, 4);
    grid::DenseMap map = drawn.map();
    unsigned pattern = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const auto beside = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(map.index({3, 3})) +
                                                   neighbour_offsets(map)[k]);
      if (map.cells[beside] == CellState::kFree) pattern |= 1U << k;
    }
    const auto before = free_topology(map);
    map.cells[map.index({3, 3})] = CellState::kOccupied;
    RC_ASSERT(is_simple(pattern) == (free_topology(map) == before));
  }));
}

TEST(SimpleCell, StaysOneWhenTurnedAndMirrored) {
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    const unsigned turned = (pattern << 2U | pattern >> 6U) & 255U;
    unsigned mirrored = 0;
    for (unsigned k = 0; k < 8; ++k) mirrored |= (pattern >> k & 1U) << ((8 - k) % 8);
    EXPECT_EQ(is_simple(turned), is_simple(pattern)) << pattern;
    EXPECT_EQ(is_simple(mirrored), is_simple(pattern)) << pattern;
  }
}

TEST(SimpleCell, IsNoneAloneOrAmidFreeSpace) {
  EXPECT_FALSE(is_simple(0));
  EXPECT_FALSE(is_simple(255));
  for (unsigned corner = 1; corner < 8; corner += 2) {
    EXPECT_TRUE(is_simple(1U << corner)) << "an end";
    EXPECT_FALSE(is_simple(255U & ~(1U << corner))) << "a hole would come about";
  }
}

}  // namespace
}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/thinning.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

TEST(Thinning, HasAPatternOfTheNeighboursThatAreOn) {
  EXPECT_TRUE(rc::check([] {
    const grid::DenseMap map = DrawnMap(*rc::gen::inRange(1, 5), *rc::gen::inRange(1, 5)).map();
    const auto offsets = neighbour_offsets(map);
    Thinning thinning;
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      thinning.marks.push_back(static_cast<std::uint8_t>(*rc::gen::inRange(0, 64)));
    for (std::uint32_t i = 0; i < map.cells.size(); ++i) {
      if (map.is_on_border(map.cell(i))) continue;
      unsigned expected = 0;
      for (std::size_t k = 0; k < offsets.size(); ++k) {
        const auto beside = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + offsets[k]);
        if ((thinning.marks[beside] & Thinning::kOn) != 0) expected |= 1U << k;
      }
      RC_ASSERT(thinning.pattern_at(i, offsets) == expected);
    }
  }));
}

/// What is taken away in between brings back whoever is beside it, and so nobody needs to look at the others.
TEST(Thinning, OfWhatIsInDoubtIsThatOfAll) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map = DrawnMap(60, 50).free(2, 2, 58, 48).map();
    draw_patches(map, 12, 9);
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    Thinning doubted = thin_to_ridge(map, erode(map, clearance_m));
    thin_to_lines(map, doubted);
    for (int k = *rc::gen::inRange(0, 6); k > 0 && !doubted.remain.empty(); --k) {
      const auto at = *rc::gen::inRange<std::size_t>(0, doubted.remain.size());
      doubted.take_away(doubted.remain[at], neighbour_offsets(map), [](std::uint32_t) {});
      doubted.remain.erase(doubted.remain.begin() + static_cast<std::ptrdiff_t>(at));
    }
    Thinning all = doubted;
    for (const std::uint32_t i : all.remain) all.marks[i] |= Thinning::kDoubted;
    thin_to_lines(map, doubted);
    thin_to_lines(map, all);
    RC_ASSERT(doubted.remain == all.remain);
    RC_ASSERT(doubted.marks == all.marks);
  }));
}

}  // namespace
}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/slopes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "core/grid/clearance_update.hpp"
#include "core/places/skeleton/erosion.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::CellState;

grid::DenseMap patched_map() {
  grid::DenseMap map = DrawnMap(*rc::gen::inRange(5, 150), *rc::gen::inRange(5, 40)).map();
  draw_patches(map, *rc::gen::inRange(0, 20), 30);
  return map;
}

TEST(Slopes, LeadWhereClearanceRisesMost) {
  EXPECT_TRUE(rc::check([] {
    const grid::DenseMap map = patched_map();
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const auto offsets = neighbour_offsets(map);
    const std::vector<Slope> slopes = slopes_of(map, clearance_m);
    RC_ASSERT(slopes.size() == map.cells.size());
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      const bool closed = map.cells[i] != CellState::kFree || map.is_on_border(map.cell(i));
      RC_ASSERT((slopes[i] == kClosed) == closed);
      if (closed) continue;
      const auto rise_m = [&](std::size_t k) {
        const auto j = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + offsets[k % 8]);
        return (clearance_m[j] - clearance_m[i]) * (k % 2 == 0 ? 1.0F : 0.70711F);
      };
      const std::size_t up = slopes[i];
      RC_ASSERT(up <= kFlat);
      for (std::size_t k = 0; k < 8; k += 2) RC_ASSERT((up == kFlat ? 0.0F : rise_m(up)) >= rise_m(k));
      if (up == kFlat) continue;
      RC_ASSERT(rise_m(up) > 0.0F);
      // A diagonal lies between the two sides to which clearance rises more.
      if (up % 2 == 0) continue;
      RC_ASSERT(rise_m(up - 1) >= rise_m(up + 3) && rise_m(up + 1) >= rise_m(up + 5));
    }
  }));
}

TEST(Slopes, NeverLeadThroughTheCornerWhereTwoWallsMeet) {
  EXPECT_TRUE(rc::check([] {
    // Single cells, with any clearance: of distances none rises through such a corner.
    grid::DenseMap map = DrawnMap(24, 12).map();
    std::vector<float> clearance_m(map.cells.size(), 0.0F);
    for (std::size_t i = 0; i < clearance_m.size(); ++i) {
      if (map.is_on_border(map.cell(i)) || *rc::gen::inRange(0, 2) == 0) continue;
      map.cells[i] = CellState::kFree;
      clearance_m[i] = 0.01F * static_cast<float>(*rc::gen::inRange(1, 100));
    }
    const auto slopes = slopes_of(map, clearance_m);
    const auto offsets = neighbour_offsets(map);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      if (slopes[i] >= kFlat || slopes[i] % 2 == 0) continue;
      const auto is_free = [&](std::size_t k) {
        return map.cells[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + offsets[k % 8])] ==
               CellState::kFree;
      };
      RC_ASSERT(is_free(slopes[i]));
      const bool any_side = is_free(slopes[i] + 7U) || is_free(slopes[i] + 1U);
      RC_ASSERT(any_side);
    }
  }));
}

}  // namespace
}  // namespace topo::places

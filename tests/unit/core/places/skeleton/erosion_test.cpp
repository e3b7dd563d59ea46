// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/erosion.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <map>

#include "core/grid/clearance_update.hpp"
#include "core/grid/distance.hpp"
#include "core/places/skeleton/simple_cell.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

std::vector<float> clearance_of(const DenseMap& map) {
  return grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
}

/// Higher than several strips of rows that are settled together.
DenseMap random_map() {
  DrawnMap drawn(70, 110);
  drawn.free(2, 2, 68, 108);
  DenseMap map = drawn.map();
  draw_patches(map, *rc::gen::inRange(0, 60), 24);
  return map;
}

/// The definition: cell after cell in rising order of clearance, what is beside a kept cell at the end of its
/// bucket. What must stay by itself is taken from the erosion under test.
std::vector<std::uint32_t> kept_one_by_one(const DenseMap& map, const std::vector<float>& clearance_m,
                                           const Erosion& erosion) {
  std::vector<bool> on(map.cells.size()), is_kept(map.cells.size(), false);
  std::map<int, std::vector<std::uint32_t>> buckets;
  for (std::uint32_t i = 0; i < on.size(); ++i) {
    on[i] = map.cells[i] == CellState::kFree;
    if (on[i])
      buckets[static_cast<int>(clearance_m[i] * static_cast<float>(8.0 / map.resolution_m))].push_back(i);
  }
  const auto offsets = neighbour_offsets(map);
  const auto beside = [&](std::uint32_t i, std::size_t k) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + offsets[k]);
  };
  std::vector<std::uint32_t> kept;
  const auto take = [&](std::uint32_t i) {
    unsigned pattern = 0;
    for (std::size_t k = 0; k < 8; ++k) pattern |= (on[beside(i, k)] ? 1U : 0U) << k;
    if ((erosion.states[i] & Erosion::kRidge) == 0 && is_simple(pattern)) {
      on[i] = false;
    } else {
      is_kept[i] = true;
      kept.push_back(i);
    }
  };
  for (const auto& [bucket, cells] : buckets) {
    std::vector<std::uint32_t> last;
    for (const std::uint32_t i : cells) {
      const bool waits =
          is_kept[beside(i, 0)] || is_kept[beside(i, 2)] || is_kept[beside(i, 4)] || is_kept[beside(i, 6)];
      if (waits) last.push_back(i);
      if (!waits) take(i);
    }
    for (const std::uint32_t i : last) take(i);
  }
  return kept;
}

TEST(Erosion, KeepsWhatCellByCellWouldBeKept) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = random_map();
    const std::vector<float> clearance_m = clearance_of(map);
    const Erosion erosion = erode(map, clearance_m);
    RC_ASSERT(erosion.kept == kept_one_by_one(map, clearance_m, erosion));
  }));
}

/// A map that is none: what is free there would have neighbours outside the array.
TEST(Erosion, NeverLooksBeyondTheArray) {
  DrawnMap drawn(70, 110);
  drawn.free(2, 2, 68, 108);
  DenseMap map = drawn.map();
  for (std::uint32_t i = 0; i < map.cells.size(); ++i)
    if (map.is_on_border(map.cell(i))) map.cells[i] = CellState::kFree;
  const Erosion erosion = erode(map, clearance_of(map));
  for (std::uint32_t i = 0; i < map.cells.size(); ++i) {
    if (map.is_on_border(map.cell(i))) {
      EXPECT_EQ(erosion.states[i], 0);
    }
  }
}

TEST(Erosion, OfNothingIsNothing) { EXPECT_TRUE(erode(DenseMap{}, {}).states.empty()); }

}  // namespace
}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/watershed.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "core/places/skeleton/erosion.hpp"
#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::places {
namespace {

/// Slopes of any kind, on a map whose border is closed.
std::vector<Slope> any_slopes(const grid::DenseMap& map) {
  std::vector<Slope> slopes(map.cells.size(), kClosed);
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (map.is_on_border(map.cell(i)) || *rc::gen::inRange(0, 6) == 0) continue;
    slopes[i] = *rc::gen::inRange<Slope>(0, kFlat + 1);
    if (*rc::gen::inRange(0, 12) == 0) slopes[i] |= kOnAxis;
  }
  return slopes;
}

bool is_open(Slope slope) { return (slope & (kClosed | kOnAxis)) == 0; }

/// The definition: from the changed cells and what is beside them, up, down, and across what is flat.
std::vector<bool> basins(const grid::DenseMap& map, const std::vector<Slope>& slopes,
                         const std::vector<std::uint32_t>& changed) {
  const auto offsets = neighbour_offsets(map);
  std::vector<bool> in(slopes.size(), false);
  std::vector<std::uint32_t> queue;
  const auto beside = [&](std::uint32_t i, std::size_t k) {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets[k]);
  };
  const auto visit = [&](std::uint32_t i) {
    if (!is_open(slopes[i]) || in[i]) return;
    in[i] = true;
    queue.push_back(i);
  };
  for (const std::uint32_t i : changed) {
    visit(i);
    for (std::size_t k = 0; k < 8; ++k) visit(beside(i, k));
  }
  while (!queue.empty()) {
    const std::uint32_t i = queue.back();
    queue.pop_back();
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t j = beside(i, k);
      const Slope there = slopes[j] & kNumber;
      if (slopes[i] == kFlat || slopes[i] == k || there == kFlat || there == (k + 4) % 8) visit(j);
    }
  }
  return in;
}

TEST(Watershed, FindsAllThatHangsOnAChangeAndNothingElse) {
  EXPECT_TRUE(rc::check([] {
    const grid::DenseMap map = DrawnMap(*rc::gen::inRange(2, 60), *rc::gen::inRange(2, 20)).map();
    std::vector<Slope> slopes = any_slopes(map);
    const std::vector<Slope> before = slopes;
    std::vector<std::uint32_t> changed;
    for (std::uint32_t i = 0; i < slopes.size(); ++i)
      if (!map.is_on_border(map.cell(i)) && *rc::gen::inRange(0, 150) == 0) changed.push_back(i);
    const std::vector<bool> expected = basins(map, slopes, changed);
    const grid::CellBlocks found = find_basins(map, changed, slopes);
    std::vector<bool> in_blocks(slopes.size(), false);
    found.for_each([&](std::size_t first, std::size_t end) {
      RC_ASSERT(std::find(expected.begin() + static_cast<std::ptrdiff_t>(first),
                          expected.begin() + static_cast<std::ptrdiff_t>(end),
                          true) != expected.begin() + static_cast<std::ptrdiff_t>(end));
      for (std::size_t i = first; i < end; ++i) in_blocks[i] = true;
    });
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      RC_ASSERT(slopes[i] == (before[i] | (expected[i] ? kVisited : 0)));
      if (expected[i]) RC_ASSERT(in_blocks[i]);
    }
  }));
}

TEST(Watershed, WithoutAChangeNothingIsFound) {
  const grid::DenseMap map = DrawnMap(20, 10).map();
  std::vector<Slope> slopes(map.cells.size(), kFlat);
  bool any = false;
  find_basins(map, {}, slopes).for_each([&](std::size_t, std::size_t) { any = true; });
  EXPECT_FALSE(any);
  EXPECT_EQ(std::ranges::count(slopes, kFlat), static_cast<std::ptrdiff_t>(slopes.size()));
}

}  // namespace
}  // namespace topo::places

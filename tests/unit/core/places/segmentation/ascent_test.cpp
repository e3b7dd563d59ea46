// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/ascent.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "core/places/skeleton/erosion.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::CellState;

/// A map with its slopes, and a label for some of its free cells.
struct Slopes {
  Slopes() {
    draw_patches(map, *rc::gen::inRange(0, 20), 20);
    slopes = slopes_of(map, grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown));
    labels.assign(map.cells.size(), 0);
    const int rare = *rc::gen::element(3, 30, 400);
    for (std::uint32_t i = 0; i < labels.size(); ++i)
      if (map.cells[i] == CellState::kFree && *rc::gen::inRange(0, rare) == 0) labels[i] = i + 1;
  }
  [[nodiscard]] std::uint32_t beside(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + neighbour_offsets(map)[k]);
  }

  grid::DenseMap map = DrawnMap(60, 50).free(2, 2, 58, 48).map();
  std::vector<Slope> slopes;
  std::vector<std::uint32_t> labels;
};

TEST(Ascent, ACellHasTheLabelOfTheOneItLeadsUpTo) {
  EXPECT_TRUE(rc::check([] {
    const Slopes before;
    std::vector<std::uint32_t> labels = before.labels;
    Ascent ascent(before.map, before.slopes, labels);
    for (std::uint32_t i = 0; i < labels.size(); ++i)
      if (before.map.cells[i] == CellState::kFree) ascent.climb(i);
    for (std::uint32_t i = 0; i < labels.size(); ++i) {
      RC_ASSERT((labels[i] == 0) == (before.map.cells[i] != CellState::kFree));
      if (labels[i] == 0) continue;
      const bool had_one = before.labels[i] != 0;
      if (had_one) RC_ASSERT(labels[i] == before.labels[i]);
      const Slope up = before.slopes[i];
      if (!had_one && up != kFlat) RC_ASSERT(labels[i] == labels[before.beside(i, up)]);
      if (had_one || up != kFlat || labels[i] == kLost) continue;
      bool is_beside = false;
      for (std::size_t k = 0; k < 8; ++k) is_beside = is_beside || labels[before.beside(i, k)] == labels[i];
      RC_ASSERT(is_beside);
    }
  }));
}

TEST(Ascent, TheLostAreThoseWithoutALabelEachOnce) {
  EXPECT_TRUE(rc::check([] {
    Slopes at;
    Ascent ascent(at.map, at.slopes, at.labels);
    for (std::uint32_t i = 0; i < at.labels.size(); ++i)
      if (at.map.cells[i] == CellState::kFree) ascent.climb(i);
    std::vector<std::uint32_t> expected, lost = ascent.lost();
    for (std::uint32_t i = 0; i < at.labels.size(); ++i)
      if (at.labels[i] == kLost) expected.push_back(i);
    std::ranges::sort(lost);
    RC_ASSERT(lost == expected);
  }));
}

TEST(Ascent, ALongWayIsLabelledToItsBeginning) {
  // A corridor of 300 cells of which all lead to the east.
  const grid::DenseMap map = DrawnMap(300, 1).free(0, 0, 300, 1).map();
  std::vector<Slope> slopes(map.cells.size(), 0);
  std::vector<std::uint32_t> labels(map.cells.size(), 0);
  labels[map.index({299, 0})] = 5;
  Ascent ascent(map, slopes, labels);
  ascent.climb(static_cast<std::uint32_t>(map.index({0, 0})));
  for (int x = 0; x < 300; ++x) EXPECT_EQ(labels[map.index({x, 0})], 5U) << x;
  EXPECT_TRUE(ascent.lost().empty());
}

}  // namespace
}  // namespace topo::places

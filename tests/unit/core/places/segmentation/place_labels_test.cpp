// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/place_labels.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace topo::places {
namespace {

TEST(PlaceLabels, AreThoseOfTheCellsThatWereLabelled) {
  EXPECT_TRUE(rc::check([] {
    PlaceLabels labels;
    std::vector<std::uint16_t> expected;
    const int runs = *rc::gen::inRange(0, 40);
    for (int k = 0; k < runs; ++k) {
      expected.resize(expected.size() + *rc::gen::element<std::size_t>(0, 0, 1, 30, 511, 512, 2000), 0);
      const auto first = static_cast<std::uint32_t>(expected.size());
      const auto label = *rc::gen::inRange<std::uint16_t>(1, 4);
      expected.resize(expected.size() + *rc::gen::element<std::size_t>(1, 7, 512, 1500), label);
      labels.append(first, static_cast<std::uint32_t>(expected.size()), label);
    }
    expected.resize(expected.size() + 1000, 0);
    RC_ASSERT(labels.empty() == (runs == 0));
    RC_ASSERT(labels.by_cell(expected.size()) == expected);
    for (std::size_t i = 0; i < expected.size(); ++i) RC_ASSERT(labels[i] == expected[i]);
  }));
}

TEST(PlaceLabels, AreTheSameInHoweverManyPieces) {
  PlaceLabels whole, pieces;
  whole.append(100, 900, 7);
  for (std::uint32_t i = 100; i < 900; i += 50) pieces.append(i, i + 50, 7);
  EXPECT_TRUE(whole == pieces);
}

TEST(PlaceLabels, LeaveWhatIsNotFree) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map;
    map.box = {{0, 0}, {69, 2}};
    const auto state = rc::gen::element(grid::CellState::kFree, grid::CellState::kFree,
                                        grid::CellState::kUnknown, grid::CellState::kOccupied);
    map.cells = *rc::gen::container<std::vector<grid::CellState>>(210, state);
    PlaceLabels labels;
    labels.append(3, 90, 1);
    labels.append(90, 130, 2);
    labels.append(140, 210, 1);
    std::vector<std::uint16_t> expected = labels.by_cell(210);
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (map.cells[i] != grid::CellState::kFree) expected[i] = 0;
    RC_ASSERT(labels.on_free_cells(map).by_cell(210) == expected);
  }));
}

}  // namespace
}  // namespace topo::places

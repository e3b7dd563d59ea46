// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/piece_runs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::places {
namespace {

TEST(PieceRuns, AreOfOneLabelEachAndKnowTheirClearest) {
  const DrawnMap drawn = DrawnMap(12, 3).free(1, 1, 8, 2);
  const auto row = static_cast<std::uint32_t>(drawn.map().index({0, 1}));
  std::vector<std::uint32_t> labels(drawn.map().cells.size(), 0);
  std::vector<float> clearance_m(labels.size(), 0.0F);
  for (std::uint32_t x = 1; x < 8; ++x) {
    labels[row + x] = x < 4 ? 7 : 9;
    clearance_m[row + x] = 0.1F * static_cast<float>(x);
  }
  const std::vector<PieceRun> expected = {{row + 1, row + 4, 7, 0.1F * 3.0F},
                                          {row + 4, row + 8, 9, 0.1F * 7.0F}};
  EXPECT_EQ(piece_runs(drawn.map(), clearance_m, labels), expected);

  // The first piece takes over from the second: one run grows, the other gives way.
  labels[row + 4] = 7;
  grid::CellBlocks changed(labels.size());
  changed.add(row + 4);
  const std::vector<PieceRun> then = {{row + 1, row + 5, 7, 0.1F * 4.0F}, {row + 5, row + 8, 9, 0.1F * 7.0F}};
  EXPECT_EQ(renewed_runs(expected, changed, clearance_m, labels), then);
  EXPECT_EQ(renewed_runs(then, grid::CellBlocks(labels.size()), clearance_m, labels), then);
}

/// A row of pieces, each some cells long, with walls between some.
std::vector<std::uint32_t> row_of_pieces(std::size_t width) {
  std::vector<std::uint32_t> labels(width, 0);
  for (std::size_t x = 1; x + 1 < width;) {
    const std::size_t end = std::min(x + static_cast<std::size_t>(*rc::gen::inRange(1, 90)), width - 1);
    const auto label = static_cast<std::uint32_t>(*rc::gen::inRange(0, 3));
    while (x < end) labels[x++] = label;
  }
  return labels;
}

TEST(PieceRuns, RenewedAreThoseOfTheWholeMap) {
  EXPECT_TRUE(rc::check("wherever labels have changed", [] {
    constexpr int kWidth = 400;
    DrawnMap drawn(kWidth, 3);
    drawn.free(1, 1, kWidth - 1, 2);
    const std::size_t row = drawn.map().index({0, 1});
    const auto at = [&](const std::vector<std::uint32_t>& pieces) {
      std::vector<std::uint32_t> labels(drawn.map().cells.size(), 0);
      std::copy(pieces.begin(), pieces.end(), labels.begin() + static_cast<std::ptrdiff_t>(row));
      return labels;
    };
    const std::vector<float> clearance_m(drawn.map().cells.size(), 0.5F);
    const auto before = at(row_of_pieces(kWidth)), other = at(row_of_pieces(kWidth));
    auto labels = before;
    grid::CellBlocks changed(labels.size());
    for (int n = *rc::gen::inRange(1, 5); n > 0; --n) {
      const auto first = static_cast<std::size_t>(*rc::gen::inRange(0, kWidth - 1));
      const std::size_t end =
          std::min<std::size_t>(first + static_cast<std::size_t>(*rc::gen::inRange(1, 60)), kWidth - 1);
      for (std::size_t i = row + first; i < row + end; ++i) {
        labels[i] = other[i];
        changed.add(static_cast<std::uint32_t>(i));
      }
    }
    RC_ASSERT(renewed_runs(piece_runs(drawn.map(), clearance_m, before), changed, clearance_m, labels) ==
              piece_runs(drawn.map(), clearance_m, labels));
  }));
}

}  // namespace
}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/piece_runs.hpp"

#include <gtest/gtest.h>

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
  CellBlocks changed(labels.size());
  changed.add(row + 4);
  const std::vector<PieceRun> then = {{row + 1, row + 5, 7, 0.1F * 4.0F}, {row + 5, row + 8, 9, 0.1F * 7.0F}};
  EXPECT_EQ(renewed_runs(expected, changed, clearance_m, labels), then);
  EXPECT_EQ(renewed_runs(then, CellBlocks(labels.size()), clearance_m, labels), then);
}

}  // namespace
}  // namespace topo::places

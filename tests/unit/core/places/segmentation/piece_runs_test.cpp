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
}

TEST(PieceRuns, TogetherAreTheLabelsAndNoneGoesOn) {
  EXPECT_TRUE(rc::check([] {
    const int width = *rc::gen::inRange(3, 40), height = *rc::gen::inRange(3, 12);
    const DrawnMap drawn = DrawnMap(width, height).free(1, 1, width - 1, height - 1);
    std::vector<std::uint32_t> labels(drawn.map().cells.size(), 0);
    std::vector<float> clearance_m(labels.size(), 0.0F);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (drawn.map().cells[i] != grid::CellState::kFree) continue;
      labels[i] = *rc::gen::inRange<std::uint32_t>(0, 3);
      clearance_m[i] = 0.05F * static_cast<float>(*rc::gen::inRange(1, 20));
    }
    std::vector<std::uint32_t> from_runs(labels.size(), 0);
    std::uint32_t end_before = 0, label_before = 0;
    for (const PieceRun& run : piece_runs(drawn.map(), clearance_m, labels)) {
      RC_ASSERT(run.first >= end_before);
      RC_ASSERT(run.first > end_before || run.label != label_before);
      RC_ASSERT(run.clearance_m == *std::max_element(&clearance_m[run.first], clearance_m.data() + run.end));
      std::fill(from_runs.begin() + run.first, from_runs.begin() + run.end, run.label);
      end_before = run.end;
      label_before = run.label;
    }
    RC_ASSERT(from_runs == labels);
  }));
}

}  // namespace
}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/free_runs.hpp"

#include <gtest/gtest.h>

#include "core/grid/cell_run.hpp"
#include "tests/unit/core/grid/maps.hpp"

namespace topo::grid {
namespace {

/// The same cell by cell.
std::vector<CellRun> free_runs_by_cell(const std::vector<CellState>& cells, std::size_t from,
                                       std::size_t to) {
  std::vector<CellRun> runs;
  for (std::size_t i = from; i < to; ++i) {
    const auto at = static_cast<std::uint32_t>(i);
    if (cells[i] != CellState::kFree) continue;
    if (!runs.empty() && runs.back().end == at)
      ++runs.back().end;
    else
      runs.push_back({at, at + 1});
  }
  return runs;
}

TEST(FreeRuns, AreThoseFoundCellByCell) {
  EXPECT_TRUE(rc::check([] {
    std::vector<CellState> cells(*rc::gen::inRange<std::size_t>(1, 90));
    const int share = *rc::gen::element(2, 10, 30);  // one cell of so many is not free
    for (CellState& cell : cells) {
      cell = *rc::gen::inRange(0, share) == 0 ? *rc::gen::element(CellState::kOccupied, CellState::kUnknown)
                                              : CellState::kFree;
    }
    const auto from = *rc::gen::inRange<std::size_t>(0, cells.size() + 1);
    const auto to = *rc::gen::inRange<std::size_t>(from, cells.size() + 1);
    std::vector<CellRun> runs;
    for_each_free_run(cells, from, to, [&](std::size_t first, std::size_t end) {
      runs.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end)});
    });
    RC_ASSERT(runs == free_runs_by_cell(cells, from, to));
    const std::size_t end = end_of_free(cells, from, to);
    RC_ASSERT(
        std::all_of(&cells[0] + from, &cells[0] + end, [](CellState s) { return s == CellState::kFree; }));
    if (end < to) RC_ASSERT(cells[end] != CellState::kFree);
    RC_ASSERT(end <= to);
  }));
}

TEST(FreeRuns, OfAMapEndWithItsRowsAndKnowTheirCell) {
  EXPECT_TRUE(rc::check([] {
    DenseMap map = random_map(40);
    const CellIndex by{*rc::gen::inRange(-50, 50), *rc::gen::inRange(-50, 50)};
    map.box = {{map.box.min.x + by.x, map.box.min.y + by.y}, {map.box.max.x + by.x, map.box.max.y + by.y}};
    std::vector<bool> free(map.cells.size());
    std::size_t last_end = 0;
    for_each_free_run(map, [&](const FreeRun& run) {
      RC_ASSERT(run.first < run.end);
      RC_ASSERT(run.first >= last_end);
      last_end = run.end;
      RC_ASSERT(map.cell(run.first) == run.cell);
      RC_ASSERT(map.cell(run.end - 1).y == run.cell.y);
      for (std::size_t i = run.first; i < run.end; ++i) free[i] = true;
    });
    for (std::size_t i = 0; i < map.cells.size(); ++i)
      RC_ASSERT(free[i] == (map.cells[i] == CellState::kFree));
  }));
}

TEST(FreeRuns, OfNothingAreNone) {
  for_each_free_run(DenseMap{}, [](const FreeRun&) { ADD_FAILURE() << "a run of an empty map"; });
  const std::vector<CellState> free(20, CellState::kFree);
  for_each_free_run(free, 7, 7, [](std::size_t, std::size_t) { ADD_FAILURE() << "a run of no cells"; });
  EXPECT_EQ(end_of_free(free, 7, 7), 7U);
  EXPECT_EQ(end_of_free(free, 3, 19), 19U);
}

}  // namespace
}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/known_span.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

namespace topo::grid {
namespace {

TEST(KnownSpan, IsFromTheFirstToTheLastKnownCell) {
  EXPECT_TRUE(rc::check([] {
    std::vector<CellState> cells(*rc::gen::inRange<std::size_t>(0, 70), CellState::kUnknown);
    if (!cells.empty()) {
      for (int known = *rc::gen::inRange(0, 4); known > 0; --known) {
        cells[*rc::gen::inRange<std::size_t>(0, cells.size())] =
            *rc::gen::element(CellState::kFree, CellState::kOccupied);
      }
    }
    const std::size_t from = *rc::gen::inRange<std::size_t>(0, cells.size() + 1);
    const std::size_t to = *rc::gen::inRange<std::size_t>(from, cells.size() + 1);
    const CellSpan span = known_span(cells, from, to);
    RC_ASSERT(span.first <= span.end);
    if (!span.empty()) {
      RC_ASSERT(span.first >= from);
      RC_ASSERT(span.end <= to);
      RC_ASSERT(cells[span.first] != CellState::kUnknown);
      RC_ASSERT(cells[span.end - 1] != CellState::kUnknown);
    }
    for (std::size_t i = from; i < to; ++i)
      RC_ASSERT((i >= span.first && i < span.end) || cells[i] == CellState::kUnknown);
  }));
}

}  // namespace
}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/cell_blocks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

namespace topo::grid {
namespace {

TEST(CellBlocks, HoldAllThatWasAddedAndNoMoreThanTheBlocksAroundIt) {
  EXPECT_TRUE(rc::check([] {
    const auto cells = *rc::gen::inRange<std::uint32_t>(1, 500);
    CellBlocks blocks(cells), by_cell(cells);
    std::vector<bool> was_added(cells), is_held(cells);
    for (int k = *rc::gen::inRange(0, 4); k > 0; --k) {
      const auto first = *rc::gen::inRange<std::uint32_t>(0, cells),
                 end = *rc::gen::inRange<std::uint32_t>(first + 1, cells + 1);
      blocks.add({first, end});
      for (std::uint32_t i = first; i < end; ++i) {
        by_cell.add(i);
        was_added[i] = true;
      }
    }
    std::vector<std::size_t> ends, ends_by_cell;
    blocks.for_each([&](std::size_t first, std::size_t end) {
      RC_ASSERT((ends.empty() || ends.back() < first));
      ends.insert(ends.end(), {first, end});
      for (std::size_t i = first; i < end; ++i) is_held[i] = true;
    });
    by_cell.for_each([&](std::size_t first, std::size_t end) {
      ends_by_cell.insert(ends_by_cell.end(), {first, end});
    });
    for (std::size_t i = 0; i < cells; ++i) RC_ASSERT((is_held[i] || !was_added[i]));
    RC_ASSERT(ends == ends_by_cell);
  }));
}

}  // namespace
}  // namespace topo::grid

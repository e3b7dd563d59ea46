// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/other_blocks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <vector>

namespace topo::grid {
namespace {

/// How cells lie in rows and blocks.
struct Layout {
  std::size_t width = *rc::gen::inRange<std::size_t>(1, 90);
  std::size_t height = *rc::gen::inRange<std::size_t>(1, 6);
  std::size_t block = *rc::gen::inRange<std::size_t>(1, 40);

  [[nodiscard]] std::vector<CellState> free_cells() const {
    return std::vector<CellState>(width * height, CellState::kFree);
  }
};

TEST(OtherBlocks, AreThoseWithAnotherCell) {
  EXPECT_TRUE(rc::check([] {
    const Layout layout;
    const std::size_t width = layout.width, block = layout.block;
    const std::vector<CellState> a = layout.free_cells();
    std::vector<CellState> b = a;
    for (int k = *rc::gen::inRange(0, 5); k > 0; --k)
      b[*rc::gen::inRange<std::size_t>(0, b.size())] = CellState::kOccupied;
    std::vector<CellState> taken = a;
    std::size_t end = 0;
    for_each_other_block(a, b, width, block, [&](std::size_t y, std::size_t x, std::size_t count) {
      const std::size_t first = y * width + x;
      RC_ASSERT(x % block == 0 && count <= block && x + count <= width);
      RC_ASSERT(first >= end);
      end = first + count;
      RC_ASSERT(std::count(&b[first], &b[first] + count, CellState::kOccupied) > 0);
      std::copy_n(&b[first], count, &taken[first]);
    });
    RC_ASSERT(taken == b);
  }));
}

}  // namespace
}  // namespace topo::grid

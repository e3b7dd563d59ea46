// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/cells_beside.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <set>
#include <vector>

namespace topo::places {
namespace {

/// One by one.
std::vector<std::uint32_t> expected_of(const grid::DenseMap& map, const std::set<std::uint32_t>& cells) {
  std::set<std::uint32_t> beside;
  for (const std::uint32_t i : cells) {
    const grid::CellIndex c = map.cell(i);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const grid::CellIndex n{c.x + dx, c.y + dy};
        if (map.contains(n) && !map.is_on_border(n)) beside.insert(static_cast<std::uint32_t>(map.index(n)));
      }
    }
  }
  return {beside.begin(), beside.end()};
}

TEST(CellsBeside, AreThoseAroundAndTheCellsEachOnce) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map;
    map.box = {{0, 0}, {*rc::gen::inRange(0, 9), *rc::gen::inRange(0, 9)}};
    map.cells.resize(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()));
    std::set<std::uint32_t> cells;
    for (int k = *rc::gen::inRange(0, 12); k > 0; --k)
      cells.insert(*rc::gen::inRange(0U, static_cast<std::uint32_t>(map.cells.size())));
    std::vector<std::uint32_t> found;
    for (const grid::CellRun& run : cells_and_beside(map, std::vector(cells.begin(), cells.end())))
      for (std::uint32_t i = run.first; i < run.end; ++i) found.push_back(i);
    RC_ASSERT(found == expected_of(map, cells));
  }));
}

}  // namespace
}  // namespace topo::places

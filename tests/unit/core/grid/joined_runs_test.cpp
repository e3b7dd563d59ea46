// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/joined_runs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <string>
#include <vector>

namespace topo::grid {
namespace {

/// The runs of '.' in a drawn map.
void add_drawn(const std::string& cells, std::size_t width, JoinedRuns& runs) {
  runs.clear(width);
  for (std::size_t row = 0; row < cells.size(); row += width) {
    for (std::size_t i = row; i < row + width; ++i) {
      const std::size_t first = i;
      while (i < row + width && cells[i] == '.') ++i;
      if (i > first) runs.add({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(i)});
    }
  }
}

/// Which cells hang together with one.
std::vector<bool> joined(JoinedRuns& runs, std::size_t cells, std::uint32_t with) {
  std::vector<bool> is(cells, false);
  const std::uint32_t root = runs.root_of(runs.run_of(with));
  for (std::uint32_t run = 0; run < runs.size(); ++run) {
    if (runs.root_of(run) != root) continue;
    for (std::uint32_t i = runs[run].first; i < runs[run].end; ++i) is[i] = true;
  }
  return is;
}

/// The same, cell by cell.
std::vector<bool> flooded(const std::string& cells, std::size_t width, std::size_t from) {
  const auto columns = static_cast<int>(width), rows = static_cast<int>(cells.size() / width);
  std::vector<bool> is(cells.size(), false);
  std::vector<std::size_t> queue{from};
  is[from] = true;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int x = static_cast<int>(queue[next] % width), y = static_cast<int>(queue[next] / width);
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, rows - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, columns - 1); ++u) {
        const auto i = static_cast<std::size_t>(v * columns + u);
        if (is[i] || cells[i] != '.') continue;
        is[i] = true;
        queue.push_back(i);
      }
    }
  }
  return is;
}

TEST(JoinedRuns, HangTogetherAsAFloodFillHasThem) {
  JoinedRuns runs;
  EXPECT_TRUE(rc::check([&] {
    const auto width = *rc::gen::inRange<std::size_t>(1, 24), height = *rc::gen::inRange<std::size_t>(1, 24);
    const int share = *rc::gen::inRange(0, 9);
    std::string cells(width * height, '#');
    for (char& cell : cells)
      if (*rc::gen::inRange(0, 10) > share) cell = '.';
    const std::size_t open = cells.rfind('.');
    RC_PRE(open != std::string::npos);
    add_drawn(cells, width, runs);
    const std::vector<bool> expected = flooded(cells, width, open);
    RC_ASSERT(joined(runs, cells.size(), static_cast<std::uint32_t>(open)) == expected);
    std::size_t left = width, right = 0, low = height, high = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!expected[i]) continue;
      left = std::min(left, i % width);
      right = std::max(right, i % width + 1);
      low = std::min(low, i / width);
      high = std::max(high, i / width);
    }
    const std::uint32_t root = runs.root_of(runs.run_of(static_cast<std::uint32_t>(open)));
    const JoinedRuns::Extent extent = runs.extents()[root];
    RC_ASSERT(extent.left == left && extent.right == right && extent.low == low && extent.high == high);
  }));
}

TEST(JoinedRuns, OfMarksAreThoseAddedOneByOne) {
  JoinedRuns one_by_one, marked;
  EXPECT_TRUE(rc::check([&] {
    const auto width = *rc::gen::inRange<std::size_t>(1, 80);
    std::string cells(2 * width, '#');
    for (char& cell : cells)
      if (*rc::gen::arbitrary<bool>()) cell = '.';
    add_drawn(cells, width, one_by_one);
    marked.clear(width);
    for (std::size_t row = 0; row < cells.size(); row += width) {
      std::vector<std::uint8_t> marks;
      for (std::size_t x = 0; x < width; ++x) marks.push_back(cells[row + x] == '.' ? 1 : 0);
      marked.add_marked(row, marks);
    }
    RC_ASSERT(marked.size() == one_by_one.size());
    for (std::uint32_t run = 0; run < marked.size(); ++run) {
      RC_ASSERT(marked[run] == one_by_one[run]);
      RC_ASSERT(marked.root_of(run) == one_by_one.root_of(run));
    }
  }));
}

TEST(JoinedRuns, TouchAtCornersAndRoundAWall) {
  JoinedRuns runs;
  const std::string cells =
      "#######"
      "#.###.#"
      "##.#.##"
      "#.###.#"
      "#..#..#"
      "#######";
  add_drawn(cells, 7, runs);
  const std::vector<bool> left = joined(runs, cells.size(), 8);
  EXPECT_TRUE(left[30]);
  EXPECT_FALSE(left[12]) << "the two sides never meet";
}

TEST(JoinedRuns, DoNotTouchRoundTheEndsOfRowsNorAcrossAnEmptyOne) {
  JoinedRuns runs;
  const std::string cells =
      "###."
      ".###"
      "####"
      ".###";
  add_drawn(cells, 4, runs);
  ASSERT_EQ(runs.size(), 3U);
  for (std::uint32_t run = 0; run < runs.size(); ++run) EXPECT_EQ(runs.root_of(run), run);
}

}  // namespace
}  // namespace topo::grid

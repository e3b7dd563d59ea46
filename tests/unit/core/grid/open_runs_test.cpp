// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/open_runs.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>

namespace topo::grid {
namespace {

constexpr float kClosed = HUGE_VALF;

/// '.' is open.
std::vector<float> costs(const std::string& drawn) {
  std::vector<float> cost;
  for (const char c : drawn) cost.push_back(c == '.' ? 1.0F : kClosed);
  return cost;
}

std::vector<bool> connected(OpenRuns& runs, std::size_t cells, std::uint32_t to) {
  std::vector<bool> is(cells, false);
  runs.for_each_connected(to, [&](OpenRuns::Run run) {
    for (std::uint32_t i = run.first; i < run.end; ++i) is[i] = true;
  });
  return is;
}

/// The same, cell by cell.
std::vector<bool> flooded(const std::vector<float>& cost, std::size_t width, std::uint32_t from) {
  std::vector<bool> is(cost.size(), false);
  std::vector<std::size_t> queue{from};
  is[from] = true;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    for (const std::size_t row : {queue[next] - width, queue[next], queue[next] + width}) {
      for (const std::size_t i : {row - 1, row, row + 1}) {
        if (is[i] || std::isinf(cost[i])) continue;
        is[i] = true;
        queue.push_back(i);
      }
    }
  }
  return is;
}

TEST(OpenRuns, hangTogetherAsAFloodFillHasThem) {
  OpenRuns runs;
  EXPECT_TRUE(rc::check([&] {
    const auto width = *rc::gen::inRange<std::size_t>(3, 24), height = *rc::gen::inRange<std::size_t>(3, 24);
    const int share = *rc::gen::inRange(1, 9);
    std::vector<float> cost(width * height, kClosed);
    std::uint32_t open = 0;
    for (std::size_t y = 1; y + 1 < height; ++y) {
      for (std::size_t x = 1; x + 1 < width; ++x) {
        if (*rc::gen::inRange(0, 10) > share) continue;
        open = static_cast<std::uint32_t>(y * width + x);
        cost[open] = 1.0F;
      }
    }
    RC_PRE(open != 0);
    runs.take(cost, width);
    RC_ASSERT(connected(runs, cost.size(), open) == flooded(cost, width, open));
  }));
}

TEST(OpenRuns, touchAtCornersAndRoundAWall) {
  OpenRuns runs;
  const std::vector<float> cost = costs(
      "#######"
      "#.###.#"
      "##.#.##"
      "#.###.#"
      "#..#..#"
      "#######");
  runs.take(cost, 7);
  const std::vector<bool> left = connected(runs, cost.size(), 8);
  EXPECT_TRUE(left[30]);
  EXPECT_FALSE(left[12]) << "the two sides never meet";
}

}  // namespace
}  // namespace topo::grid

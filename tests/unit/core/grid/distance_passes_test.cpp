// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/distance_passes.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/grid/column_steps.hpp"

namespace topo::grid {
namespace {

TEST(RunEnvelope, IsTheLeastOfAllParabolas) {
  EXPECT_TRUE(rc::check([] {
    const std::vector<Steps> row = any_column_steps(120);
    const int width = static_cast<int>(row.size());
    const int first = *rc::gen::inRange(0, width), end = *rc::gen::inRange(first + 1, width + 1);
    const bool before = *rc::gen::arbitrary<bool>(), after = *rc::gen::arbitrary<bool>();
    RunEnvelope envelope(row.size());
    std::vector<std::int32_t> out(row.size(), -1);
    for (int again = 0; again < 2; ++again) envelope.run(row.data(), first, end, before, after, out.data());
    for (int x = 0; x < width; ++x) {
      std::int32_t expected = std::numeric_limits<std::int32_t>::max();
      if (before) expected = std::min(expected, (x - first + 1) * (x - first + 1));
      if (after) expected = std::min(expected, (end - x) * (end - x));
      for (int c = first; c < end; ++c) {
        const int steps = row[static_cast<std::size_t>(c)];
        if (steps < kNone) expected = std::min(expected, (c - x) * (c - x) + steps * steps);
      }
      RC_ASSERT(out[static_cast<std::size_t>(x)] == (x >= first && x < end ? expected : -1));
    }
  }));
}

TEST(StepsOn, CountFromTheLastBoundaryCellOfTheColumn) {
  EXPECT_TRUE(rc::check([] {
    const auto width = *rc::gen::inRange<std::size_t>(1, 70);
    std::vector<CellState> cells(width);
    std::vector<Steps> beside(width), known(width), occupied(width);
    for (std::size_t x = 0; x < width; ++x) {
      cells[x] = *rc::gen::element(CellState::kFree, CellState::kOccupied, CellState::kUnknown);
      beside[x] = *rc::gen::element<Steps>(0, 1, 500, kNone - 1, kNone);
    }
    steps_on<Boundary::kOccupiedOrUnknown>(cells.data(), beside.data(), known.data(), width);
    steps_on<Boundary::kOccupied>(cells.data(), beside.data(), occupied.data(), width);
    for (std::size_t x = 0; x < width; ++x) {
      const int next = std::min<int>(beside[x] + 1, kNone);
      RC_ASSERT(known[x] == (cells[x] == CellState::kFree ? next : 0));
      RC_ASSERT(occupied[x] == (cells[x] == CellState::kOccupied ? 0 : next));
    }
    const std::vector<Steps> before = known;
    steps_back(beside.data(), known.data(), width);
    for (std::size_t x = 0; x < width; ++x) RC_ASSERT(known[x] == std::min<int>(before[x], beside[x] + 1));
  }));
}

TEST(RowPass, OfAnyPartOfARowIsTheLeastOverAllColumns) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Steps> row = any_column_steps(600);
    for (int walls = *rc::gen::inRange(0, 4); walls > 0; --walls)
      row[*rc::gen::inRange<std::size_t>(0, row.size())] = 0;
    const bool open_outside = *rc::gen::arbitrary<bool>();
    const double resolution_m = *rc::gen::element(0.05, 0.1, 1.0);
    RowPass pass(row.size(), resolution_m, open_outside);
    for (int parts = 0; parts < 3; ++parts) {
      const auto from = *rc::gen::inRange<std::size_t>(0, row.size());
      const auto end = *rc::gen::inRange<std::size_t>(from, row.size() + 1);
      std::vector<float> out(row.size(), -1.0F);
      std::fill(out.begin() + static_cast<std::ptrdiff_t>(from),
                out.begin() + static_cast<std::ptrdiff_t>(end), 0.0F);
      pass.cells(row.data(), static_cast<int>(from), static_cast<int>(end), out.data());
      for (std::size_t x = 0; x < row.size(); ++x) {
        if (x < from || x >= end) {
          RC_ASSERT(out[x] == -1.0F);
          continue;
        }
        const std::int64_t square = least_square(row, x, open_outside);
        if (square == std::numeric_limits<std::int64_t>::max()) {
          RC_ASSERT(std::isinf(out[x]));
        } else {
          const double expected_m = resolution_m * std::sqrt(static_cast<double>(square));
          RC_ASSERT(std::abs(static_cast<double>(out[x]) - expected_m) <= 1e-6 * expected_m);
        }
      }
    }
  }));
}

}  // namespace
}  // namespace topo::grid

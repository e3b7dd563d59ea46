// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/grid/near_squares.hpp"

namespace topo::grid {

/// Column distances of a row of at most `width_max` cells: few, many or no boundaries, near and far.
inline std::vector<Steps> any_column_steps(std::size_t width_max) {
  std::vector<Steps> row(*rc::gen::inRange<std::size_t>(1, width_max + 1), kNone);
  const int near = *rc::gen::element(0, 1, 10, 100), steps_max = *rc::gen::element(3, 60, 300, 20000);
  for (Steps& steps : row)
    if (*rc::gen::inRange(0, 100) < near) steps = *rc::gen::inRange<Steps>(0, static_cast<Steps>(steps_max));
  return row;
}

/// Squared distance of cell `i` to the nearest boundary by all columns, those beside the row too; the
/// greatest number when there is none.
inline std::int64_t least_square(const std::vector<Steps>& row, std::size_t i, bool open_outside) {
  const auto width = static_cast<std::int64_t>(row.size()), x = static_cast<std::int64_t>(i);
  std::int64_t best = std::numeric_limits<std::int64_t>::max();
  if (!open_outside) best = std::min((x + 1) * (x + 1), (width - x) * (width - x));
  for (std::int64_t c = 0; c < width; ++c) {
    const std::int64_t steps = row[static_cast<std::size_t>(c)];
    if (steps < kNone) best = std::min(best, (c - x) * (c - x) + steps * steps);
  }
  return best;
}

}  // namespace topo::grid

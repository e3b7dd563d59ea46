// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/near_squares.hpp"

#include <algorithm>

namespace topo::grid {
namespace {

/// By value: the references of std::min keep the compiler from vectorising.
constexpr std::int16_t lesser(std::int16_t a, std::int16_t b) { return b < a ? b : a; }

}  // namespace

std::int16_t NearSquares::greatest(const Block& block) {
  std::int16_t most = 0;
  for (const std::int16_t square : block) most = most < square ? square : most;
  return most;
}

NearSquares::NearSquares(std::size_t width, bool open_outside)
    : width_(width), squares_(width + 2 * kReach + kBlock, open_outside ? kFar : std::int16_t{0}) {}

void NearSquares::take(const Steps* row, std::size_t from, std::size_t end) {
  const std::size_t first = from - std::min(from, kReach), behind = std::min(width_, end + kReach);
  std::int16_t* const squares = &squares_[kReach];
  for (std::size_t x = first; x < behind; ++x) {
    const auto square = static_cast<std::int16_t>(row[x] * row[x]);
    squares[x] = row[x] > static_cast<Steps>(kReach) ? kFar : square;
  }
}

NearSquares::Block NearSquares::of_block(std::size_t first) const {
  const std::int16_t* const at = &squares_[kReach + first];
  Block best;
  std::copy_n(at, kBlock, best.begin());
  int most = greatest(best);
  constexpr int kTries = 4;  // steps between two updates of the maximum
  for (int k = 1; k <= static_cast<int>(kReach) && k * k < most; ++k) {
    const auto square = static_cast<std::int16_t>(k * k);
    const std::int16_t *const left = at - k, *const right = at + k;
    for (std::size_t i = 0; i < kBlock; ++i)
      best[i] = lesser(best[i], static_cast<std::int16_t>(lesser(left[i], right[i]) + square));
    if (k % kTries == 0) most = greatest(best);
  }
  return best;
}

}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/place_blocks.hpp"

#include <cstring>

namespace topo::slam {
namespace {

/// The sums of a block's row: a vector extension of GCC and clang, because GCC 12 does not vectorise the
/// plain loop.
using Row = std::uint16_t __attribute__((vector_size(2 * PlaceBlocks::kSide)));

}  // namespace

PlaceBlocks::PlaceBlocks(const LikelihoodPyramid& pyramid, int level) : level_(level) {
  // A border of one block's width of zeros on either side: blocks that overlap the border need no bounds
  // check.
  const int step = 1 << level;
  squares_ = (pyramid.width() + step - 1) / step + 2 * kSide;
  maxima_.reserve(static_cast<std::size_t>(step) * static_cast<std::size_t>(step) *
                  static_cast<std::size_t>(squares_) * static_cast<std::size_t>(squares_));
  for (int py = 0; py < step; ++py) {
    for (int px = 0; px < step; ++px) {
      for (int y = -kSide; y < squares_ - kSide; ++y) {
        for (int x = -kSide; x < squares_ - kSide; ++x)
          maxima_.push_back(pyramid.at(level, x * step + px, y * step + py));
      }
    }
  }
}

PlaceBlocks::Scores PlaceBlocks::score(std::span<const CellOffset> points, int x, int y) const {
  const int step = 1 << level_, last = squares_ - kSide;
  const auto squares = static_cast<std::size_t>(squares_);
  std::array<Row, kSide> sums{};
  for (const CellOffset& point : points) {
    const int cx = point.x + x, cy = point.y + y;
    const int sx = (cx >> level_) + kSide, sy = (cy >> level_) + kSide;
    if (sx < 0 || sy < 0 || sx > last || sy > last) continue;
    const auto plane = static_cast<std::size_t>((cy & (step - 1)) * step + (cx & (step - 1)));
    const std::uint16_t* from =
        &maxima_[(plane * squares + static_cast<std::size_t>(sy)) * squares + static_cast<std::size_t>(sx)];
    for (Row& sum : sums) {
      Row row;
      std::memcpy(&row, from, sizeof row);
      sum += row;
      from += squares;
    }
  }
  Scores scores;
  std::memcpy(&scores, &sums, sizeof scores);
  return scores;
}

}  // namespace topo::slam

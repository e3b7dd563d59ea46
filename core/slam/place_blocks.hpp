// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/slam/search.hpp"

namespace topo::slam {

/// One level of a pyramid, laid out so that 8 x 8 places are scored at once: the contributions of a point to
/// eight neighbouring squares are contiguous, and one instruction adds them to the eight sums.
class PlaceBlocks {
 public:
  static constexpr int kSide = 8;              ///< places along a side of a block
  static constexpr std::size_t kPoints = 250;  ///< maximum number of points: scores are summed in 16 bits
  /// Sums of likelihoods in 255ths, row by row from the lower left.
  using Scores = std::array<std::uint16_t, static_cast<std::size_t>(kSide) * kSide>;

  PlaceBlocks(const LikelihoodPyramid& pyramid, int level);

  /// Scores of the block whose lower left square begins at the cell (x, y): the sums of pyramid.at(level)
  /// over at most kPoints points, at cells relative to each square's lower left one.
  [[nodiscard]] Scores score(std::span<const CellOffset> points, int x, int y) const;

 private:
  int level_;
  int squares_ = 0;                    ///< along the side of a plane
  std::vector<std::uint16_t> maxima_;  ///< a plane of squares for every cell offset of their origin
};

}  // namespace topo::slam

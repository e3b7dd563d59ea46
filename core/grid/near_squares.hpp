// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace topo::grid {

/// Distance along the column, in cells; kNone where the column has no boundary. kNone is the 16-bit signed
/// maximum less one, so that one can be added. Signed, because SSE2, which every amd64 machine has, computes
/// the minimum of signed 16-bit numbers only. Squares of distances and their sums fit 32 bits.
using Steps = std::int16_t;
inline constexpr Steps kNone = 32766;

/// Squared distances from a row's cells to the nearest boundary, exact while small, as most are. The columns
/// beside a cell are tried nearest first, for many cells at once in vector instructions, until none can be
/// nearer.
class NearSquares {
 public:
  static constexpr std::size_t kBlock = 32;
  /// Half of the 16-bit maximum: the sum of two smaller squares fits.
  static constexpr std::int16_t kFar = 16383;
  using Block = std::array<std::int16_t, kBlock>;

  /// `width`: cells per row. Space beside the row is open, or boundary.
  NearSquares(std::size_t width, bool open_outside);

  /// Takes the column distances of a row. `row` is the whole row; only distances that affect its cells [from,
  /// end) are read.
  void take(const Steps* row, std::size_t from, std::size_t end);

  /// Squared distances of the block of cells from `first` on, within that range. Exact below kFar, which
  /// stands for all greater ones. Values past the end of the range are meaningless.
  [[nodiscard]] Block of_block(std::size_t first) const;

  [[nodiscard]] static std::int16_t greatest(const Block& block);

 private:
  static constexpr std::size_t kReach = 127;  ///< columns tried to each side; its square is below kFar
  std::size_t width_;
  std::vector<std::int16_t> squares_;  ///< of the column distances, with padding: kReach before the row, more
                                       ///< behind
};

}  // namespace topo::grid

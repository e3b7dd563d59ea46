// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace topo::grid {

/// Distance along the column, in cells; kNone where the column has no boundary. The maximum of 16 signed bits
/// less one, so that one more fits: SSE2, which every amd64 machine has, knows the minimum of signed ones
/// only. Squares of distances and their sums then fit 32 bits.
using Steps = std::int16_t;
inline constexpr Steps kNone = 32766;

/// Squares of the distances from a row's cells to the nearest boundary, as far as they are small, which most
/// are: the columns beside a cell are tried one after the other, nearest first, for many cells at once in
/// vector instructions, until none can be nearer.
class NearSquares {
 public:
  static constexpr std::size_t kBlock = 32;
  /// Half of what fits, less one: the sum of two squares below it fits.
  static constexpr std::int16_t kFar = 16383;
  using Block = std::array<std::int16_t, kBlock>;

  /// Of rows of so many cells; beside them all is open, or all is boundary.
  NearSquares(std::size_t width, bool open_outside);

  /// The distances along the columns of a whole row. Those that matter to its cells [from, end) are looked
  /// at.
  void take(const Steps* row, std::size_t from, std::size_t end);

  /// Of the block of cells that begins with one of those; exact below kFar, which stands for all that is not.
  /// What lies past the end has no meaning.
  [[nodiscard]] Block of_block(std::size_t first) const;

  [[nodiscard]] static std::int16_t greatest(const Block& block);

 private:
  static constexpr std::size_t kReach = 127;  ///< of the columns that are tried; its square is below kFar
  std::size_t width_;
  std::vector<std::int16_t> squares_;  ///< along the columns, kReach of them before the row and more behind
};

}  // namespace topo::grid

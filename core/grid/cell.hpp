// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace topo::grid {

enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

/// Index of a cell: cell (0, 0) has its lower left corner at the origin of the map frame.
struct CellIndex {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend bool operator==(const CellIndex&, const CellIndex&) = default;
};

/// Steps to the cells that share a side with one: east, north, west, south.
inline constexpr std::array<CellIndex, 4> kSideSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Inclusive range of cells; empty while min > max.
struct CellBox {
  CellIndex min{INT32_MAX, INT32_MAX};
  CellIndex max{INT32_MIN, INT32_MIN};
  [[nodiscard]] bool empty() const { return min.x > max.x || min.y > max.y; }
  [[nodiscard]] std::int64_t width() const { return empty() ? 0 : std::int64_t{max.x} - min.x + 1; }
  [[nodiscard]] std::int64_t height() const { return empty() ? 0 : std::int64_t{max.y} - min.y + 1; }
  void extend(CellIndex cell) {
    min = {std::min(min.x, cell.x), std::min(min.y, cell.y)};
    max = {std::max(max.x, cell.x), std::max(max.y, cell.y)};
  }
  friend bool operator==(const CellBox&, const CellBox&) = default;
};

}  // namespace topo::grid

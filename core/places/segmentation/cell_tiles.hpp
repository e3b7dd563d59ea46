// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid/cell_run.hpp"
#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Cells in square tiles: a fast test whether some of them may lie within a box.
class CellTiles {
 public:
  explicit CellTiles(const grid::DenseMap& map)
      : min_(map.box.min),
        width_(static_cast<std::size_t>(map.width())),
        columns_((width_ >> kShift) + 1),
        rows_((static_cast<std::size_t>(map.height()) >> kShift) + 1),
        holds_(columns_ * rows_, 0) {}

  /// Cells of the map by index, in one row or several.
  void add(grid::CellRun run) {
    for (std::size_t first = run.first; first < run.end;) {
      const std::size_t y = first / width_, end = std::min<std::size_t>(run.end, (y + 1) * width_);
      std::uint8_t* const row = &holds_[(y >> kShift) * columns_];
      std::fill(row + ((first - y * width_) >> kShift), row + ((end - 1 - y * width_) >> kShift) + 1,
                std::uint8_t{1});
      first = end;
    }
  }

  /// False only when no added cell lies within the box.
  [[nodiscard]] bool may_have(const grid::CellBox& box) const {
    const auto tile = [](std::int64_t at, std::int64_t origin, std::size_t count) {
      return static_cast<std::size_t>(
          std::clamp<std::int64_t>((at - origin) >> kShift, 0, static_cast<std::int64_t>(count) - 1));
    };
    const std::size_t left = tile(box.min.x, min_.x, columns_), right = tile(box.max.x, min_.x, columns_);
    for (std::size_t row = tile(box.min.y, min_.y, rows_); row <= tile(box.max.y, min_.y, rows_); ++row) {
      const std::uint8_t* const tiles = &holds_[row * columns_];
      if (std::find(tiles + left, tiles + right + 1, 1) != tiles + right + 1) return true;
    }
    return false;
  }

 private:
  static constexpr unsigned kShift = 5;
  grid::CellIndex min_;
  std::size_t width_, columns_, rows_;
  std::vector<std::uint8_t> holds_;
};

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::travel {

/// A dense map drawn with characters, one a cell, the uppermost row first: '#' occupied, '.' free, else
/// unknown. Its lower left cell is (0, 0).
inline grid::DenseMap drawn_map(const std::vector<std::string>& rows, double resolution_m = 0.05) {
  grid::DenseMap map;
  map.resolution_m = resolution_m;
  map.box.min = {0, 0};
  map.box.max = {static_cast<std::int32_t>(rows.front().size()) - 1,
                 static_cast<std::int32_t>(rows.size()) - 1};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char c : *row) {
      map.cells.push_back(c == '#'   ? grid::CellState::kOccupied
                          : c == '.' ? grid::CellState::kFree
                                     : grid::CellState::kUnknown);
    }
  }
  return map;
}

/// The same as text again.
inline std::vector<std::string> text_of(const grid::DenseMap& map) {
  std::vector<std::string> rows;
  for (int y = map.height() - 1; y >= 0; --y) {
    std::string row;
    for (int x = 0; x < map.width(); ++x) {
      const grid::CellState state = map.state({map.box.min.x + x, map.box.min.y + y});
      row += state == grid::CellState::kOccupied ? '#' : state == grid::CellState::kFree ? '.' : ' ';
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace topo::travel

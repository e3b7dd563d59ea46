// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/grid/distance.hpp"
#include "core/grid/wavefront.hpp"

namespace topo::grid {

/// Rows from above: '.' free, '#' occupied, anything else unknown. The lower left cell is (0, 0).
inline DenseMap drawn_map(const std::vector<std::string>& rows) {
  DenseMap map;
  if (rows.empty()) return map;
  map.box.extend({0, 0});
  map.box.extend({static_cast<int>(rows.front().size()) - 1, static_cast<int>(rows.size()) - 1});
  for (std::size_t i = rows.size(); i-- > 0;) {
    for (const char c : rows[i]) {
      map.cells.push_back(c == '.'   ? CellState::kFree
                          : c == '#' ? CellState::kOccupied
                                     : CellState::kUnknown);
    }
  }
  return map;
}

/// All cells of one state, with one unknown cell around them.
inline DenseMap filled_map(int width, int height, CellState state) {
  DenseMap map;
  map.box = {{-1, -1}, {width, height}};
  map.cells.assign(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()),
                   CellState::kUnknown);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) map.cells[map.index({x, y})] = state;
  return map;
}

/// Ways over what is known, by the usual rules.
inline TravelField field_from(const DenseMap& map, CellIndex start) {
  return travel_field(map, clearance_m(map, Boundary::kOccupiedOrUnknown), start, {});
}

/// Mostly free, with rectangles of the three states thrown in.
inline DenseMap random_map(int side_max) {
  const int width = *rc::gen::inRange(1, side_max), height = *rc::gen::inRange(1, side_max);
  DenseMap map = filled_map(width, height, *rc::gen::element(CellState::kFree, CellState::kUnknown));
  const int rectangles = *rc::gen::inRange(0, 12);
  for (int i = 0; i < rectangles; ++i) {
    const int x0 = *rc::gen::inRange(0, width), y0 = *rc::gen::inRange(0, height);
    const int x1 = std::min(width, x0 + *rc::gen::inRange(1, 12)),
              y1 = std::min(height, y0 + *rc::gen::inRange(1, 12));
    const auto state = *rc::gen::element(CellState::kFree, CellState::kOccupied, CellState::kUnknown);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) map.cells[map.index({x, y})] = state;
  }
  return map;
}

}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/grid/distance.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/places/segmentation/segment_places.hpp"
#include "core/places/skeleton/skeleton.hpp"

namespace topo::places {

/// A map of unknown space of the given size in cells, without its margin, to draw in.
class DrawnMap {
 public:
  DrawnMap(int width, int height, double resolution_m = 0.05) {
    map_.resolution_m = resolution_m;
    map_.box = {{-1, -1}, {width, height}};
    map_.cells.assign(static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height + 2),
                      grid::CellState::kUnknown);
  }

  /// Cells from (x0, y0) to (x1 - 1, y1 - 1).
  DrawnMap& fill(int x0, int y0, int x1, int y1, grid::CellState state) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) map_.cells[map_.index({x, y})] = state;
    }
    return *this;
  }
  DrawnMap& free(int x0, int y0, int x1, int y1) { return fill(x0, y0, x1, y1, grid::CellState::kFree); }
  DrawnMap& occupied(int x0, int y0, int x1, int y1) {
    return fill(x0, y0, x1, y1, grid::CellState::kOccupied);
  }
  /// Free space with a wall of two cells around it.
  DrawnMap& room(int x0, int y0, int x1, int y1) {
    return occupied(x0 - 2, y0 - 2, x1 + 2, y1 + 2).free(x0, y0, x1, y1);
  }

  [[nodiscard]] const grid::DenseMap& map() const { return map_; }
  [[nodiscard]] std::vector<float> clearance() const {
    return grid::clearance_m(map_, grid::Boundary::kOccupiedOrUnknown);
  }
  [[nodiscard]] PlaceMap places(double compass_rad = 0.0, std::vector<types::Segment> walls = {}) const {
    const auto clearance_m = clearance();
    return segment_places(map_, clearance_m, skeletonise(map_, clearance_m), walls, compass_rad);
  }

 private:
  grid::DenseMap map_;
};

/// Turned by a quarter about the origin, counter-clockwise.
inline grid::DenseMap turned(const grid::DenseMap& map) {
  grid::DenseMap out = map;
  out.box = {{-map.box.max.y - 1, map.box.min.x}, {-map.box.min.y - 1, map.box.max.x}};
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const grid::CellIndex c = map.cell(i);
    out.cells[out.index({-c.y - 1, c.x})] = map.cells[i];
  }
  return out;
}

/// Number of connected sets of cells for which `in` holds, over four or eight neighbours.
template <class F>
int count_components(const grid::DenseMap& map, bool corners, F&& in) {
  std::vector<bool> seen(map.cells.size(), false);
  std::vector<grid::CellIndex> stack;
  int count = 0;
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (seen[i] || !in(i)) continue;
    ++count;
    seen[i] = true;
    stack.assign(1, map.cell(i));
    while (!stack.empty()) {
      const grid::CellIndex c = stack.back();
      stack.pop_back();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const grid::CellIndex n{c.x + dx, c.y + dy};
          if ((dx != 0 && dy != 0 && !corners) || !map.contains(n)) continue;
          const std::size_t j = map.index(n);
          if (seen[j] || !in(j)) continue;
          seen[j] = true;
          stack.push_back(n);
        }
      }
    }
  }
  return count;
}

}  // namespace topo::places

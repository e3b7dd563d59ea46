// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/occupied_points.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace topo::compass {
namespace {

/// True when a straight neighbour of an occupied cell is not occupied. Precondition: the cell is not on the
/// map's border.
bool on_surface(const grid::CellState* at, std::ptrdiff_t up) {
  const auto is_occupied = [at](std::ptrdiff_t by) { return at[by] == grid::CellState::kOccupied; };
  return !(is_occupied(1) && is_occupied(-1) && is_occupied(up) && is_occupied(-up));
}

void append_row(const grid::DenseMap& map, std::size_t number, std::vector<types::Vector2>& points) {
  static_assert(sizeof(grid::CellState) == 1);
  const auto width = static_cast<std::size_t>(map.width());
  const grid::CellState* const row = &map.cells[number * width];
  const grid::CellState* const end = row + width;
  const bool is_outermost = number == 0 || number + 1 == static_cast<std::size_t>(map.height());
  const double y_m = map.centre_of({map.box.min.x, map.box.min.y + static_cast<std::int32_t>(number)}).y();
  for (const grid::CellState* at = row; at != end; ++at) {
    if (*at != grid::CellState::kOccupied) {
      // Most cells are not occupied: memchr tests many at once.
      at = static_cast<const grid::CellState*>(
          std::memchr(at, static_cast<int>(grid::CellState::kOccupied), static_cast<std::size_t>(end - at)));
      if (at == nullptr) break;
    }
    // All cells outside the map are unknown.
    if (is_outermost || at == row || at + 1 == end || on_surface(at, map.width()))
      points.emplace_back(
          map.centre_of({map.box.min.x + static_cast<std::int32_t>(at - row), map.box.min.y}).x(), y_m);
  }
}

}  // namespace

std::vector<types::Vector2> occupied_points(const grid::DenseMap& map) {
  std::vector<types::Vector2> points;
  for (std::size_t row = 0; row < static_cast<std::size_t>(map.height()); ++row) append_row(map, row, points);
  return points;
}

}  // namespace topo::compass

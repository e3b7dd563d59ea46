// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/occupied_points.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "core/compass/replace_part.hpp"

namespace topo::compass {
namespace {

/// True when a straight neighbour of an occupied cell is not occupied. Precondition: the cell is not on the
/// map's border.
bool on_surface(const grid::CellState* at, std::ptrdiff_t up) {
  const auto is_occupied = [at](std::ptrdiff_t by) { return at[by] == grid::CellState::kOccupied; };
  return !(is_occupied(1) && is_occupied(-1) && is_occupied(up) && is_occupied(-up));
}

double middle_of_row(const grid::DenseMap& map, std::size_t row) {
  return map.centre_of({map.box.min.x, map.box.min.y + static_cast<std::int32_t>(row)}).y();
}

void append_row(const grid::DenseMap& map, std::size_t number, std::vector<types::Vector2>& points) {
  static_assert(sizeof(grid::CellState) == 1);
  const auto width = static_cast<std::size_t>(map.width());
  const grid::CellState* const row = &map.cells[number * width];
  const grid::CellState* const end = row + width;
  const bool is_outermost = number == 0 || number + 1 == static_cast<std::size_t>(map.height());
  const double y_m = middle_of_row(map, number);
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

std::vector<types::Vector2> points_in(const grid::DenseMap& map, grid::Rows rows) {
  std::vector<types::Vector2> points;
  for (std::size_t row = rows.first; row < rows.end; ++row) append_row(map, row, points);
  return points;
}

grid::Rows all_rows(const grid::DenseMap& map) { return {0, static_cast<std::size_t>(map.height())}; }

}  // namespace

std::vector<types::Vector2> occupied_points(const grid::DenseMap& map) {
  return points_in(map, all_rows(map));
}

PointsChange OccupiedPoints::take(const grid::DenseMap& map, grid::Rows others) {
  const grid::Rows all = all_rows(map);
  auto first = points_.begin(), end = points_.end();
  if (others != all) {
    if (others.empty()) return {points_, {}, {}};
    // Whether a cell is on the surface depends on the rows beside it as well.
    others = {std::max<std::size_t>(others.first, 1) - 1, std::min(others.end + 1, all.end)};
    const double low_m = middle_of_row(map, others.first), high_m = middle_of_row(map, others.end - 1);
    first = std::partition_point(first, end, [=](const types::Vector2& p) { return p.y() < low_m; });
    end = std::partition_point(first, end, [=](const types::Vector2& p) { return p.y() <= high_m; });
  }
  const std::vector<types::Vector2> now = points_in(map, others);
  PointsChange change = points_change({first, end}, now);
  replace_part(points_, first, end, now);
  change.now = points_;
  return change;
}

}  // namespace topo::compass

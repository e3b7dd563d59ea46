// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/space_behind.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;

/// The cells around an opening: which of them a continued wall closes, and of which opening's cell those that
/// were taken are nearest.
class Window {
 public:
  Window(const grid::DenseMap& map, const grid::CellBox& box)
      : map_(map),
        box_(box),
        corners_{map.centre_of(box.min), map.centre_of(box.max)},
        marks_(static_cast<std::size_t>(box.width() * box.height()), kNone) {}

  /// Closes the cells on a straight line. Its cells touch at their corners at least: a search by sides does
  /// not pass.
  void close_along(const types::Segment& line) {
    const types::Vector2 way = line.b - line.a;
    const double length_m = way.norm();
    double from_m = 0.0, to_m = length_m;
    for (const int axis : {0, 1}) {
      const double slope = length_m > 0.0 ? way[axis] / length_m : 0.0;
      const double before_m = corners_.min[axis] - line.a[axis], after_m = corners_.max[axis] - line.a[axis];
      if (std::abs(slope) < 1e-9) {
        if (before_m > 0.0 || after_m < 0.0) return;
        continue;
      }
      from_m = std::max(from_m, std::min(before_m / slope, after_m / slope));
      to_m = std::min(to_m, std::max(before_m / slope, after_m / slope));
    }
    if (from_m > to_m) return;
    const int steps = static_cast<int>(std::ceil((to_m - from_m) / map_.resolution_m));
    for (int k = 0; k <= steps; ++k) {
      const double at_m = std::min(from_m + k * map_.resolution_m, to_m);
      const CellIndex cell = map_.cell_at(line.a + (length_m > 0.0 ? at_m / length_m : 0.0) * way);
      if (contains(cell)) marks_[index(cell)] = kWall;
    }
  }

  /// An occupied cell, or an unknown one on a continued wall.
  [[nodiscard]] bool is_wall(CellIndex cell) const {
    const CellState state = map_.state(cell);
    return state == CellState::kOccupied ||
           (state == CellState::kUnknown && contains(cell) && marks_[index(cell)] == kWall);
  }
  /// An unknown cell that is no wall and not taken.
  [[nodiscard]] bool is_open(CellIndex cell) const {
    return contains(cell) && map_.state(cell) == CellState::kUnknown && marks_[index(cell)] == kNone;
  }
  /// An unknown cell that is no wall and not taken, or one outside the window.
  [[nodiscard]] bool goes_on(CellIndex cell) const {
    return contains(cell) ? is_open(cell) : map_.state(cell) == CellState::kUnknown;
  }

  /// The opening's cell, by its number, that a taken cell is nearest to; none of another.
  [[nodiscard]] std::optional<std::uint32_t> site_of(CellIndex cell) const {
    if (!contains(cell) || marks_[index(cell)] < kFirst) return std::nullopt;
    return marks_[index(cell)] - kFirst;
  }
  void take(CellIndex cell, std::uint32_t site) { marks_[index(cell)] = kFirst + site; }

 private:
  static constexpr std::uint32_t kNone = 0, kWall = 1, kFirst = 2;

  [[nodiscard]] bool contains(CellIndex c) const {
    return c.x >= box_.min.x && c.x <= box_.max.x && c.y >= box_.min.y && c.y <= box_.max.y;
  }
  [[nodiscard]] std::size_t index(CellIndex c) const {
    return static_cast<std::size_t>(c.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(c.x - box_.min.x);
  }

  const grid::DenseMap& map_;
  grid::CellBox box_;
  types::Rectangle corners_;
  std::vector<std::uint32_t> marks_;
};

std::int64_t squared(CellIndex a, CellIndex b) {
  const std::int64_t dx = a.x - b.x, dy = a.y - b.y;
  return dx * dx + dy * dy;
}

CellIndex beside(CellIndex cell, CellIndex by) { return {cell.x + by.x, cell.y + by.y}; }

/// The cells of the space, in the order of a breadth-first search. The nearest cell of the opening is handed
/// on from side to side.
std::vector<CellIndex> cells_behind(Window& window, std::span<const CellIndex> opening, std::int64_t reach) {
  std::vector<CellIndex> cells;
  for (std::uint32_t site = 0; site < opening.size(); ++site) {
    for (const CellIndex by : grid::kSideSteps) {
      const CellIndex to = beside(opening[site], by);
      if (!window.is_open(to)) continue;
      window.take(to, site);
      cells.push_back(to);
    }
  }
  for (std::size_t next = 0; next < cells.size(); ++next) {
    const CellIndex here = cells[next];
    std::uint32_t nearest = *window.site_of(here);
    for (const CellIndex by : grid::kSideSteps) {
      const auto other = window.site_of(beside(here, by));
      if (other && squared(here, opening[*other]) < squared(here, opening[nearest])) nearest = *other;
    }
    window.take(here, nearest);
    for (const CellIndex by : grid::kSideSteps) {
      const CellIndex to = beside(here, by);
      if (!window.is_open(to) || squared(to, opening[nearest]) > reach * reach) continue;
      window.take(to, nearest);
      cells.push_back(to);
    }
  }
  return cells;
}

}  // namespace

SpaceBehind space_behind(const grid::DenseMap& map, std::span<const std::uint32_t> opening,
                         std::span<const types::Segment> continued, double reach_m) {
  const auto reach = static_cast<std::int32_t>(std::lround(reach_m / map.resolution_m));
  if (opening.empty() || reach < 1) return {};
  grid::CellBox box;
  std::vector<CellIndex> sites;
  sites.reserve(opening.size());
  for (const std::uint32_t i : opening) {
    sites.push_back(map.cell(i));
    box.extend(sites.back());
  }
  Window window(map, {{box.min.x - reach, box.min.y - reach}, {box.max.x + reach, box.max.y + reach}});
  for (const types::Segment& wall : continued) window.close_along(wall);

  const std::vector<CellIndex> cells = cells_behind(window, sites, reach);
  std::size_t walls = 0, ahead = 0;  // sides of the space's cells
  for (const CellIndex cell : cells) {
    for (const CellIndex by : grid::kSideSteps) {
      const CellIndex to = beside(cell, by);
      if (window.is_wall(to))
        ++walls;
      else if (window.goes_on(to))
        ++ahead;
    }
  }
  const double rim = static_cast<double>(walls + ahead);
  return {static_cast<double>(cells.size()) * map.resolution_m * map.resolution_m,
          ahead > 0 ? static_cast<double>(ahead) / rim : 0.0};
}

}  // namespace topo::goals

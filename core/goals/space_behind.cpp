// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/space_behind.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;

constexpr std::array<CellIndex, 4> kSides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// The cells around an opening: what closes the space behind it, and what was visited.
class Window {
 public:
  Window(const grid::DenseMap& map, const grid::CellBox& box)
      : map_(map),
        box_(box),
        corners_{map.centre_of(box.min), map.centre_of(box.max)},
        marks_(static_cast<std::size_t>(box.width() * box.height()), Mark::kOpen) {}

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
      if (contains(cell)) mark(cell) = Mark::kWall;
    }
  }

  [[nodiscard]] bool is_wall(CellIndex cell) const {
    return map_.state(cell) == CellState::kOccupied || marks_[index(cell)] == Mark::kWall;
  }
  /// True for an unknown cell that is no wall and not taken.
  [[nodiscard]] bool is_open(CellIndex cell) const {
    return map_.state(cell) == CellState::kUnknown && marks_[index(cell)] == Mark::kOpen;
  }
  void take(CellIndex cell) { mark(cell) = Mark::kTaken; }

 private:
  enum class Mark : std::uint8_t { kOpen, kWall, kTaken };

  [[nodiscard]] bool contains(CellIndex c) const {
    return c.x >= box_.min.x && c.x <= box_.max.x && c.y >= box_.min.y && c.y <= box_.max.y;
  }
  [[nodiscard]] std::size_t index(CellIndex c) const {
    return static_cast<std::size_t>(c.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(c.x - box_.min.x);
  }
  Mark& mark(CellIndex c) { return marks_[index(c)]; }

  const grid::DenseMap& map_;
  grid::CellBox box_;
  types::Rectangle corners_;
  std::vector<Mark> marks_;
};

struct Step {
  CellIndex at, from;  ///< from: the opening's cell at which the search entered the unknown
};

}  // namespace

SpaceBehind space_behind(const grid::DenseMap& map, std::span<const std::uint32_t> opening,
                         std::span<const types::Segment> continued, double reach_m) {
  if (opening.empty()) return {};
  const int reach = static_cast<int>(std::lround(reach_m / map.resolution_m));
  const int margin = reach + 1;  // of the rim
  grid::CellBox box;
  for (const std::uint32_t i : opening) box.extend(map.cell(i));
  Window window(map, {{box.min.x - margin, box.min.y - margin}, {box.max.x + margin, box.max.y + margin}});
  for (const types::Segment& wall : continued) window.close_along(wall);

  std::vector<Step> steps;
  std::size_t walls = 0, ahead = 0;  // sides of the space's cells
  for (const std::uint32_t i : opening) {
    const CellIndex cell = map.cell(i);
    for (const CellIndex by : kSides) {
      const CellIndex to{cell.x + by.x, cell.y + by.y};
      if (!window.is_open(to)) continue;
      window.take(to);
      steps.push_back({to, cell});
    }
  }
  for (std::size_t next = 0; next < steps.size(); ++next) {
    const Step step = steps[next];
    for (const CellIndex by : kSides) {
      const CellIndex to{step.at.x + by.x, step.at.y + by.y};
      const double dx = to.x - step.from.x, dy = to.y - step.from.y;
      if (window.is_wall(to)) ++walls;
      if (!window.is_open(to)) continue;
      if (dx * dx + dy * dy > static_cast<double>(reach) * reach) {
        ++ahead;
        continue;
      }
      window.take(to);
      steps.push_back({to, step.from});
    }
  }
  const double rim = static_cast<double>(walls + ahead);
  return {static_cast<double>(steps.size()) * map.resolution_m * map.resolution_m,
          ahead > 0 ? static_cast<double>(ahead) / rim : 0.0};
}

}  // namespace topo::goals

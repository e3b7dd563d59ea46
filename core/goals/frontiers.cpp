// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/goals/frontiers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/grid/joined_runs.hpp"
#include "core/grid/known_span.hpp"

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;

/// The free cells with unknown space at one of their four sides, as runs; all cells outside the array are
/// unknown.
class FrontierRuns {
 public:
  struct Cluster {
    std::uint32_t span;  ///< the greater of its numbers of columns and rows
    std::vector<std::uint32_t> cells;
  };

  explicit FrontierRuns(const DenseMap& map) : width_(static_cast<std::size_t>(map.width())), marks_(width_) {
    runs_.clear(width_);
    const std::vector<CellState> outside(width_, CellState::kUnknown);
    const CellState* const cells = map.cells.data();
    for (std::size_t row = 0; row < map.cells.size(); row += width_) {
      const CellState* below = row == 0 ? outside.data() : cells + row - width_;
      const CellState* above = row + width_ == map.cells.size() ? outside.data() : cells + row + width_;
      const grid::CellSpan known = grid::known_span(map.cells, row, row + width_);
      if (known.empty()) continue;
      mark(below, cells + row, above, known.first - row, known.end - row);
      runs_.add_marked(known.first, {&marks_[known.first - row], known.end - known.first});
    }
  }

  /// The connected clusters that span at least `span_min` columns or rows, in the order of their first cells;
  /// the cells of each are ascending.
  [[nodiscard]] std::vector<Cluster> clusters(std::uint32_t span_min) {
    const std::vector<grid::JoinedRuns::Extent> extents = runs_.extents();
    std::vector<Cluster> found;
    std::vector<std::size_t> number(runs_.size());
    for (std::uint32_t run = 0; run < runs_.size(); ++run) {
      const std::uint32_t root = runs_.root_of(run);
      const grid::JoinedRuns::Extent& e = extents[root];
      const std::uint32_t span = std::max(e.right - e.left, e.high - e.low + 1);
      if (span < span_min) continue;
      if (root == run) {
        number[run] = found.size();
        found.push_back({span, {}});
      }
      std::vector<std::uint32_t>& cluster = found[number[root]].cells;
      for (std::uint32_t i = runs_[run].first; i < runs_[run].end; ++i) cluster.push_back(i);
    }
    return found;
  }

 private:
  /// Marks the cells [first, end) of a row; the rest of the row is unknown.
  void mark(const CellState* below, const CellState* row, const CellState* above, std::size_t first,
            std::size_t end) {
    const auto unknown = [](CellState s) { return s == CellState::kUnknown ? 1U : 0U; };
    std::uint8_t* const marks = marks_.data();
    const auto mark_cell = [&](std::size_t x, unsigned beside) {
      const unsigned open = beside | unknown(below[x]) | unknown(above[x]);
      marks[x] = static_cast<std::uint8_t>(open & (row[x] == CellState::kFree ? 1U : 0U));
    };
    mark_cell(first, 1U);
    for (std::size_t x = first + 1; x + 1 < end; ++x) mark_cell(x, unknown(row[x - 1]) | unknown(row[x + 1]));
    mark_cell(end - 1, 1U);
  }

  std::size_t width_;
  std::vector<std::uint8_t> marks_;  ///< of one row
  grid::JoinedRuns runs_;
};

/// Breadth-first search from a frontier over free cells, ring by ring, up to `steps`.
class Spread {
 public:
  /// A cell by its index in the map and in the window of reachable cells.
  struct Place {
    std::uint32_t in_map;
    std::uint32_t in_window;
  };

  Spread(const DenseMap& map, const Frontier& frontier, int steps) {
    grid::CellBox box;
    for (const std::uint32_t i : frontier.cells) box.extend(map.cell(i));
    box.min = {std::max(box.min.x - steps, map.box.min.x), std::max(box.min.y - steps, map.box.min.y)};
    box.max = {std::min(box.max.x + steps, map.box.max.x), std::min(box.max.y + steps, map.box.max.y)};
    copy_window(map, box);
    for (std::size_t d = 0; d < around_.size(); ++d) {
      const CellIndex by = grid::kNeighbours[d];
      around_[d] = {static_cast<std::uint32_t>(by.x + by.y * map.width()),
                    static_cast<std::uint32_t>(by.x + by.y * static_cast<int>(box.width() + 2))};
    }
    for (const std::uint32_t i : frontier.cells) {
      const CellIndex cell = map.cell(i);
      visit({i, static_cast<std::uint32_t>((cell.y - box.min.y + 1) * (box.width() + 2) + cell.x - box.min.x +
                                           1)});
    }
  }

  [[nodiscard]] const std::vector<Place>& ring() const { return ring_; }

  void advance() {
    before_.swap(ring_);
    ring_.clear();
    for (const Place& at : before_)
      for (const Place& by : around_) visit({at.in_map + by.in_map, at.in_window + by.in_window});
  }

 private:
  /// Copies the free cells of the box, with a border of cells that are not free, so that neighbours need no
  /// bounds check.
  void copy_window(const DenseMap& map, const grid::CellBox& box) {
    const auto width = static_cast<std::size_t>(box.width());
    open_.assign((width + 2) * static_cast<std::size_t>(box.height() + 2), 0);
    std::uint8_t* to = &open_[width + 3];
    for (std::int32_t y = box.min.y; y <= box.max.y; ++y, to += width + 2) {
      const CellState* from = &map.cells[map.index({box.min.x, y})];
      for (std::size_t x = 0; x < width; ++x) to[x] = from[x] == CellState::kFree ? 1 : 0;
    }
  }
  void visit(Place at) {
    if (open_[at.in_window] == 0) return;
    open_[at.in_window] = 0;
    ring_.push_back(at);
  }

  std::array<Place, 8> around_{};
  std::vector<std::uint8_t> open_;  ///< free and not yet visited
  std::vector<Place> ring_, before_;
};

}  // namespace

std::vector<Frontier> find_frontiers(const DenseMap& map, double width_min_m) {
  std::vector<Frontier> frontiers;
  if (map.cells.empty()) return frontiers;
  // Half a thousandth of a cell of slack: 15 cells of 0.05 m are 0.75 m, regardless of rounding errors.
  const double cells_min = std::clamp(std::ceil(width_min_m / map.resolution_m - 0.0005), 0.0, 4e9);
  for (auto& [span, cells] : FrontierRuns(map).clusters(static_cast<std::uint32_t>(cells_min))) {
    types::Vector2 sum(0.0, 0.0);
    for (const std::uint32_t i : cells) sum += map.centre_of(map.cell(i));
    frontiers.push_back({sum / static_cast<double>(cells.size()), span * map.resolution_m, std::move(cells)});
  }
  return frontiers;
}

std::uint32_t middle_of(const DenseMap& map, std::span<const std::uint32_t> cells) {
  types::Vector2 sum(0.0, 0.0);
  for (const std::uint32_t i : cells) sum += map.centre_of(map.cell(i));
  const types::Vector2 centroid = sum / static_cast<double>(cells.size());
  const auto away = [&](std::uint32_t i) { return (map.centre_of(map.cell(i)) - centroid).squaredNorm(); };
  return *std::min_element(cells.begin(), cells.end(),
                           [&](std::uint32_t a, std::uint32_t b) { return away(a) < away(b); });
}

std::optional<CellIndex> approach_cell(const DenseMap& map, const Frontier& frontier,
                                       const grid::TravelField& field, double within_m) {
  if (frontier.cells.empty()) return std::nullopt;
  const int steps = static_cast<int>(within_m / map.resolution_m);
  Spread spread(map, frontier, steps);
  for (int step = 0; step <= steps && !spread.ring().empty(); ++step, spread.advance()) {
    std::optional<CellIndex> best;
    double best_m2 = HUGE_VAL;
    for (const Spread::Place& at : spread.ring()) {
      if (!field.can_stay_at(at.in_map)) continue;
      const CellIndex cell = map.cell(at.in_map);
      const double away_m2 = (map.centre_of(cell) - frontier.centroid).squaredNorm();
      if (away_m2 >= best_m2) continue;
      best = cell;
      best_m2 = away_m2;
    }
    if (best) return best;
  }
  return std::nullopt;
}

double unknown_behind_m2(const DenseMap& map, const Frontier& frontier, double reach_m) {
  if (frontier.cells.empty()) return 0.0;
  const CellIndex centre = map.cell(middle_of(map, frontier.cells));
  const int reach = static_cast<int>(std::lround(reach_m / map.resolution_m));
  const int side = 2 * reach + 1;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
  std::vector<CellIndex> open;
  bool leaves = false;
  std::size_t found = 0;
  const auto visit = [&](CellIndex c) {
    if (map.state(c) != CellState::kUnknown) return;
    const int u = c.x - centre.x + reach, v = c.y - centre.y + reach;
    if (u < 0 || v < 0 || u >= side || v >= side) {
      leaves = true;
      return;
    }
    std::uint8_t& mark = seen[static_cast<std::size_t>(v * side + u)];
    if (mark == 0) open.push_back(c);
    mark = 1;
  };
  const auto visit_sides = [&](CellIndex c) {
    visit({c.x + 1, c.y});
    visit({c.x, c.y + 1});
    visit({c.x - 1, c.y});
    visit({c.x, c.y - 1});
  };
  for (const std::uint32_t i : frontier.cells) {
    const CellIndex c = map.cell(i);
    if (std::abs(c.x - centre.x) < reach && std::abs(c.y - centre.y) < reach) visit_sides(c);
  }
  // Depth first: a space that extends beyond the square is mostly left along a straight line.
  for (; !open.empty() && !leaves; ++found) {
    const CellIndex at = open.back();
    open.pop_back();
    visit_sides(at);
  }
  return leaves ? HUGE_VAL : static_cast<double>(found) * map.resolution_m * map.resolution_m;
}

}  // namespace topo::goals

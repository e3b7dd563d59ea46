// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/goals/frontiers.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;

/// One mark a cell with a ring of unmarked cells around them, so that neighbours need no bounds.
class Marks {
 public:
  Marks(std::size_t width, std::size_t height) : stride_(width + 2), marks_(stride_ * (height + 2)) {
    for (std::size_t d = 0; d < grid::kNeighbours.size(); ++d) {
      const CellIndex by = grid::kNeighbours[d];
      around_[d] = static_cast<std::size_t>(by.y * static_cast<std::ptrdiff_t>(stride_) + by.x);
    }
  }

  [[nodiscard]] std::uint8_t* row(std::size_t y) { return &marks_[(y + 1) * stride_ + 1]; }
  [[nodiscard]] std::size_t x_of(std::size_t mark) const { return mark % stride_ - 1; }
  [[nodiscard]] std::size_t y_of(std::size_t mark) const { return mark / stride_ - 1; }

  /// The first mark from `from` on, or the end.
  [[nodiscard]] std::size_t next(std::size_t from) const {
    const void* found = from < marks_.size() ? std::memchr(&marks_[from], 1, marks_.size() - from) : nullptr;
    if (found == nullptr) return marks_.size();
    return static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - marks_.data());
  }
  [[nodiscard]] std::size_t end() const { return marks_.size(); }

  /// Takes away the marks connected to one over eight neighbours, and lists them.
  void take_cluster(std::size_t seed, std::vector<std::size_t>& cluster) {
    cluster.assign(1, seed);
    marks_[seed] = 0;
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      for (const std::size_t by : around_) {
        const std::size_t next = cluster[i] + by;
        if (marks_[next] == 0) continue;
        marks_[next] = 0;
        cluster.push_back(next);
      }
    }
  }

 private:
  std::size_t stride_;
  std::vector<std::uint8_t> marks_;
  std::array<std::size_t, 8> around_{};
};

/// Marks the free cells of a row with unknown space at one of their four sides.
void mark_row(const CellState* below, const CellState* row, const CellState* above, std::size_t width,
              std::uint8_t* marks) {
  const auto unknown = [](CellState s) { return s == CellState::kUnknown ? 1U : 0U; };
  const auto mark = [&](std::size_t x, unsigned beside) {
    const unsigned open = beside | unknown(below[x]) | unknown(above[x]);
    marks[x] = static_cast<std::uint8_t>(open & (row[x] == CellState::kFree ? 1U : 0U));
  };
  mark(0, 1U);  // beyond the array all is unknown
  for (std::size_t x = 1; x + 1 < width; ++x) mark(x, unknown(row[x - 1]) | unknown(row[x + 1]));
  mark(width - 1, 1U);
}

Marks frontier_marks(const DenseMap& map) {
  const auto width = static_cast<std::size_t>(map.width()), height = static_cast<std::size_t>(map.height());
  Marks marks(width, height);
  const std::vector<CellState> outside(width, CellState::kUnknown);
  for (std::size_t y = 0; y < height; ++y) {
    const CellState* row = &map.cells[y * width];
    const CellState* below = y == 0 ? outside.data() : row - width;
    const CellState* above = y + 1 == height ? outside.data() : row + width;
    mark_row(below, row, above, width, marks.row(y));
  }
  return marks;
}

double width_of(const grid::CellBox& box, double resolution_m) {
  return static_cast<double>(std::max(box.width(), box.height())) * resolution_m;
}

/// Spreads from a frontier over free cells, ring by ring, as far as `steps`.
class Spread {
 public:
  /// A cell by its number in the map, and in the window of cells that can be come to.
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
  /// What is free in the box, with a ring around it that is not, so that neighbours need no bounds.
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
  std::vector<std::uint8_t> open_;  ///< free, and not visited yet
  std::vector<Place> ring_, before_;
};

}  // namespace

std::vector<Frontier> find_frontiers(const DenseMap& map, double width_min_m) {
  std::vector<Frontier> frontiers;
  if (map.cells.empty()) return frontiers;
  Marks marks = frontier_marks(map);
  std::vector<std::size_t> cluster;
  for (std::size_t at = marks.next(0); at < marks.end(); at = marks.next(at + 1)) {
    marks.take_cluster(at, cluster);
    grid::CellBox box;
    types::Vector2 sum(0.0, 0.0);
    for (std::size_t& mark : cluster) {
      const CellIndex cell{map.box.min.x + static_cast<int>(marks.x_of(mark)),
                           map.box.min.y + static_cast<int>(marks.y_of(mark))};
      box.extend(cell);
      sum += map.centre_of(cell);
      mark = map.index(cell);
    }
    // Half a thousandth of a cell of slack: 15 cells of 0.05 m are 0.75 m, whatever the sum of fractions
    // says.
    const double width_m = width_of(box, map.resolution_m);
    if (width_m + 0.0005 * map.resolution_m < width_min_m) continue;
    std::sort(cluster.begin(), cluster.end());
    frontiers.push_back(
        {sum / static_cast<double>(cluster.size()), width_m, {cluster.begin(), cluster.end()}});
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
      if (std::isinf(field.cost_m[at.in_map])) continue;
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

double unknown_behind_m2(const DenseMap& map, CellIndex centre, std::span<const std::uint32_t> cells) {
  constexpr double kReachM = 1.2;
  const int reach = static_cast<int>(std::lround(kReachM / map.resolution_m));
  const int side = 2 * reach + 1;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
  std::vector<CellIndex> queue;
  bool leaves = false;
  const auto visit = [&](CellIndex c) {
    if (map.state(c) != CellState::kUnknown) return;
    const int u = c.x - centre.x + reach, v = c.y - centre.y + reach;
    if (u < 0 || v < 0 || u >= side || v >= side) {
      leaves = true;
      return;
    }
    std::uint8_t& mark = seen[static_cast<std::size_t>(v * side + u)];
    if (mark == 0) queue.push_back(c);
    mark = 1;
  };
  const auto visit_sides = [&](CellIndex c) {
    visit({c.x + 1, c.y});
    visit({c.x, c.y + 1});
    visit({c.x - 1, c.y});
    visit({c.x, c.y - 1});
  };
  for (const std::uint32_t i : cells) {
    const CellIndex c = map.cell(i);
    if (std::abs(c.x - centre.x) < reach && std::abs(c.y - centre.y) < reach) visit_sides(c);
  }
  for (std::size_t next = 0; next < queue.size() && !leaves; ++next) visit_sides(queue[next]);
  return leaves ? HUGE_VAL : static_cast<double>(queue.size()) * map.resolution_m * map.resolution_m;
}

}  // namespace topo::goals

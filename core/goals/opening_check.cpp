// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "core/goals/filters.hpp"

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;

constexpr std::array<CellIndex, 4> kSides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// The cells around an opening, as far as it is looked into.
class Surroundings {
 public:
  Surroundings(const grid::DenseMap& map, const Opening& opening, int reach) {
    for (const std::uint32_t i : opening.cells) box_.extend(map.cell(i));
    box_.min = {box_.min.x - reach, box_.min.y - reach};
    box_.max = {box_.max.x + reach, box_.max.y + reach};
    closed_.assign(static_cast<std::size_t>(box_.width() * box_.height()), 0);
  }

  /// Closes all in which the middle of a disc of this radius, in cells, would touch something occupied.
  void close_around_occupied(const grid::DenseMap& map, double radius) {
    const std::vector<std::int32_t> half = half_widths(radius);
    const auto reach = static_cast<std::int32_t>(half.size()) - 1;
    const std::int32_t y_from = std::max(box_.min.y - reach, map.box.min.y);
    const std::int32_t y_to = std::min(box_.max.y + reach, map.box.max.y);
    const std::int32_t x_from = std::max(box_.min.x - reach, map.box.min.x);
    const std::int32_t x_to = std::min(box_.max.x + reach, map.box.max.x);
    for (std::int32_t y = y_from; y <= y_to; ++y) {
      const CellState* const row = &map.cells[map.index({x_from, y})];
      for (std::int32_t x = 0; x <= x_to - x_from; ++x) {
        if (row[x] != CellState::kOccupied) continue;
        const std::int32_t first = x;
        while (x < x_to - x_from && row[x + 1] == CellState::kOccupied) ++x;
        close_around(y, x_from + first, x_from + x, half);
      }
    }
  }

  [[nodiscard]] bool is_open(CellIndex c) const { return contains(c) && closed_[index(c)] == 0; }
  void close(CellIndex c) { closed_[index(c)] = 1; }

 private:
  /// Of a disc: half the width of each row, from the middle one on, where it has any.
  static std::vector<std::int32_t> half_widths(double radius) {
    std::vector<std::int32_t> half;
    for (double v = 0.0; radius * radius - v * v > 0.0; v += 1.0)
      half.push_back(static_cast<std::int32_t>(std::ceil(std::sqrt(radius * radius - v * v))) - 1);
    return half;
  }
  /// Closes the discs around cells [first, last] of row `y`.
  void close_around(std::int32_t y, std::int32_t first, std::int32_t last,
                    const std::vector<std::int32_t>& half) {
    const auto reach = static_cast<std::int32_t>(half.size()) - 1;
    for (std::int32_t v = -reach; v <= reach; ++v) {
      if (y + v < box_.min.y || y + v > box_.max.y) continue;
      const std::int32_t wide = half[static_cast<std::size_t>(std::abs(v))];
      const std::int32_t from = std::max(first - wide, box_.min.x), to = std::min(last + wide, box_.max.x);
      if (from <= to) std::fill_n(&closed_[index({from, y + v})], to - from + 1, std::uint8_t{1});
    }
  }
  [[nodiscard]] bool contains(CellIndex c) const {
    return c.x >= box_.min.x && c.x <= box_.max.x && c.y >= box_.min.y && c.y <= box_.max.y;
  }
  [[nodiscard]] std::size_t index(CellIndex c) const {
    return static_cast<std::size_t>(c.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(c.x - box_.min.x);
  }

  grid::CellBox box_;
  std::vector<std::uint8_t> closed_;
};

struct Step {
  CellIndex at, from;  ///< from: the opening's cell where the way into the unknown began
};

}  // namespace

bool leads_to_unknown(const grid::DenseMap& map, const Opening& opening, const GoalParams& params) {
  const int reach = static_cast<int>(std::lround(params.behind_m / map.resolution_m));
  const auto enough =
      static_cast<std::size_t>(std::ceil(params.behind_m2 / (map.resolution_m * map.resolution_m)));
  Surroundings surroundings(map, opening, reach);
  surroundings.close_around_occupied(map, params.robot_radius_m / map.resolution_m);
  std::vector<Step> steps;
  bool goes_on = false;
  const auto visit_sides = [&](const Step& step) {
    for (const CellIndex by : kSides) {
      const CellIndex to{step.at.x + by.x, step.at.y + by.y};
      if (!surroundings.is_open(to) || map.state(to) != CellState::kUnknown) continue;
      surroundings.close(to);
      const double dx = to.x - step.from.x, dy = to.y - step.from.y;
      goes_on = goes_on || dx * dx + dy * dy >= static_cast<double>(reach) * reach;
      steps.push_back({to, step.from});
    }
  };
  for (const std::uint32_t i : opening.cells) {
    const CellIndex c = map.cell(i);
    if (surroundings.is_open(c)) visit_sides({c, c});
  }
  for (std::size_t next = 0; next < steps.size() && !(goes_on && steps.size() >= enough); ++next)
    visit_sides(Step(steps[next]));
  return goes_on && steps.size() >= enough;
}

}  // namespace topo::goals

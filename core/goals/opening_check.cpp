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
    const auto reach = static_cast<std::int32_t>(std::ceil(radius));
    const std::int32_t y_from = std::max(box_.min.y - reach, map.box.min.y);
    const std::int32_t y_to = std::min(box_.max.y + reach, map.box.max.y);
    const std::int32_t x_from = std::max(box_.min.x - reach, map.box.min.x);
    const std::int32_t x_to = std::min(box_.max.x + reach, map.box.max.x);
    for (std::int32_t y = y_from; y <= y_to; ++y) {
      for (std::int32_t x = x_from; x <= x_to; ++x) {
        if (map.cells[map.index({x, y})] == CellState::kOccupied) close_disc({x, y}, radius);
      }
    }
  }

  [[nodiscard]] bool is_open(CellIndex c) const { return contains(c) && closed_[index(c)] == 0; }
  void close(CellIndex c) { closed_[index(c)] = 1; }

 private:
  void close_disc(CellIndex centre, double radius) {
    const auto reach = static_cast<std::int32_t>(std::ceil(radius));
    for (std::int32_t v = -reach; v <= reach; ++v) {
      const double left = radius * radius - static_cast<double>(v) * v;
      if (left <= 0.0) continue;
      const auto half = static_cast<std::int32_t>(std::ceil(std::sqrt(left))) - 1;
      for (std::int32_t u = -half; u <= half; ++u) {
        const CellIndex c{centre.x + u, centre.y + v};
        if (contains(c)) close(c);
      }
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

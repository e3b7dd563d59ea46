// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/steering.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/goals/filters.hpp"

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;

/// Straight neighbours first, unlike grid::kNeighbours: of two equally good ones the nearer one is taken.
constexpr std::array<CellIndex, 8> kStraightFirst = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// From the input: the skeleton's own clearance is that of the map without furniture.
double clear_at(const GoalInput& input, CellIndex cell) {
  return static_cast<double>(input.clearance_m[input.map.index(cell)]);
}

std::optional<std::uint32_t> free_node(const GoalInput& input, CellIndex from, const GoalParams& params,
                                       const FreeNodes& nodes) {
  const types::Vector2 p = input.map.centre_of(from);
  const auto reach = static_cast<std::int32_t>(std::ceil(params.node_reach_m / input.map.resolution_m));
  std::optional<std::uint32_t> best;
  double best_m = params.node_reach_m;
  nodes.for_each_in_rows(from.y - reach, from.y + reach, [&](std::uint32_t n, const auto& node) {
    const double away_m = (input.map.centre_of(node.cell) - p).norm();
    const bool nearer = away_m < best_m || (best && away_m == best_m && n < *best);
    if (!nearer || clear_at(input, node.cell) < params.robot_radius_m || !sees(input.map, from, node.cell))
      return;
    best = n;
    best_m = away_m;
  });
  return best;
}

/// Ascends the distance field to clear_m, to the axis with clearance for the robot, or to a local maximum.
CellIndex climb(const GoalInput& input, CellIndex from, const GoalParams& params) {
  CellIndex here = from;
  while (true) {
    const std::size_t i = input.map.index(here);
    const auto clear_m = static_cast<double>(input.clearance_m[i]);
    if (clear_m >= params.clear_m || (input.skeleton.on[i] && clear_m >= params.robot_radius_m)) return here;
    CellIndex best = here;
    for (const CellIndex by : kStraightFirst) {
      const CellIndex next{here.x + by.x, here.y + by.y};
      if (input.map.state(next) == CellState::kFree &&
          input.clearance_m[input.map.index(next)] > input.clearance_m[input.map.index(best)])
        best = next;
    }
    if (best == here) return here;
    here = best;
  }
}

/// nearest_room() within a window around the opening.
std::optional<CellIndex> nearest_room_within(const GoalInput& input, std::span<const std::uint32_t> opening,
                                             double reach_m, const GoalParams& params) {
  const int reach = static_cast<int>(std::lround(reach_m / input.map.resolution_m));
  grid::CellBox box;
  for (const std::uint32_t i : opening) box.extend(input.map.cell(i));
  box = {{box.min.x - reach, box.min.y - reach}, {box.max.x + reach, box.max.y + reach}};
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(box.width() * box.height()), 0);
  std::vector<CellIndex> queue;
  const auto visit = [&](CellIndex c) {
    const std::int64_t u = c.x - box.min.x, v = c.y - box.min.y;
    if (u < 0 || v < 0 || u >= box.width() || v >= box.height()) return;
    std::uint8_t& mark = seen[static_cast<std::size_t>(v * box.width() + u)];
    if (mark == 0 && input.map.state(c) == CellState::kFree) queue.push_back(c);
    mark = 1;
  };
  for (const std::uint32_t i : opening) visit(input.map.cell(i));
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const CellIndex here = queue[next];
    if (static_cast<double>(input.clearance_m[input.map.index(here)]) >= params.robot_radius_m) return here;
    for (const CellIndex by : std::span(kStraightFirst).first<4>()) visit({here.x + by.x, here.y + by.y});
  }
  return std::nullopt;
}

}  // namespace

FreeNodes::FreeNodes(const places::Skeleton& skeleton)
    : nodes_(&skeleton.nodes), taken_(skeleton.nodes.size(), false) {
  for (std::uint32_t n = 0; n < nodes_->size(); ++n) rows_.push_back({(*nodes_)[n].cell.y, n});
  std::sort(rows_.begin(), rows_.end(),
            [](const Row& a, const Row& b) { return a.y != b.y ? a.y < b.y : a.node < b.node; });
}

bool sees(const grid::DenseMap& map, CellIndex a, CellIndex b) {
  const int steps = 2 * std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
  const types::Vector2 from = map.centre_of(a), step = (map.centre_of(b) - from) / std::max(steps, 1);
  for (int k = 1; k < steps; ++k) {
    if (map.state(map.cell_at(from + k * step)) != CellState::kFree) return false;
  }
  return true;
}

std::optional<CellIndex> nearest_room(const GoalInput& input, std::span<const std::uint32_t> opening,
                                      const GoalParams& params) {
  constexpr double kMostlyM = 1.0;  // mostly sufficient: saves the time of clearing the wide window
  if (const auto room = nearest_room_within(input, opening, kMostlyM, params)) return room;
  return nearest_room_within(input, opening, params.room_reach_m, params);
}

types::Vector2 steer(const GoalInput& input, const Opening& opening, CellIndex stand,
                     const GoalParams& params, FreeNodes& nodes) {
  const CellIndex from = input.map.cell(opening.middle);
  if (const auto node = free_node(input, from, params, nodes)) {
    nodes.take(*node);
    return input.map.centre_of(input.skeleton.nodes[*node].cell);
  }
  const CellIndex up = climb(input, from, params);
  const bool has_room = static_cast<double>(input.clearance_m[input.map.index(up)]) >= params.robot_radius_m;
  return input.map.centre_of(has_room ? up : stand);
}

}  // namespace topo::goals

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/goals/essential_goals.hpp"
#include "core/goals/openings.hpp"
#include "core/places/skeleton/skeleton.hpp"

namespace topo::goals {

/// The nodes of a skeleton that have no goal yet, sorted by row: a search for a near node need not visit all.
class FreeNodes {
 public:
  explicit FreeNodes(const places::Skeleton& skeleton);

  /// Calls f(number, node) for the free nodes in the rows [low, high].
  template <class F>
  void for_each_in_rows(std::int32_t low, std::int32_t high, F&& f) const {
    const auto below = [](const Row& row, std::int32_t y) { return row.y < y; };
    for (auto it = std::lower_bound(rows_.begin(), rows_.end(), low, below);
         it != rows_.end() && it->y <= high; ++it)
      if (!taken_[it->node]) f(it->node, (*nodes_)[it->node]);
  }
  void take(std::uint32_t node) { taken_[node] = true; }

 private:
  struct Row {
    std::int32_t y;
    std::uint32_t node;
  };
  const std::vector<places::SkeletonNode>* nodes_;
  std::vector<Row> rows_;  ///< ascending, by number within each row
  std::vector<bool> taken_;
};

/// The cell with robot_radius_m of clearance that is nearest to an opening through free space; empty when
/// there is none within room_reach_m.
std::optional<grid::CellIndex> nearest_room(const GoalInput& input, std::span<const std::uint32_t> opening,
                                            const GoalParams& params);

/// Steering: returns the nearest node of the skeleton within node_reach_m that has robot_radius_m of
/// clearance, is in sight of the opening and is in `nodes` (and removes it there). Without one it ascends the
/// distance field to clear_m of clearance or to the axis; where that ends with too little clearance, it
/// returns `stand`.
types::Vector2 steer(const GoalInput& input, const Opening& opening, grid::CellIndex stand,
                     const GoalParams& params, FreeNodes& nodes);

}  // namespace topo::goals

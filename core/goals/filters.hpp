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

namespace topo::goals {

/// Internal boundaries: is there another place right behind the middle of this side?
bool faces_another_place(const GoalInput& input, std::uint16_t place, Side side);

/// Unknown space behind a frontier of these cells, as far as 1.2 m around `centre`: m2, or HUGE_VAL when it
/// goes on beyond. Costs the cells of that square.
double unknown_behind_m2(const grid::DenseMap& map, grid::CellIndex centre,
                         std::span<const std::uint32_t> cells);

/// Opening check: can the robot's disc, as far as anything occupied is known, go on through the opening for
/// behind_m into unknown space, of which at least behind_m2 can be had so? Shadows of furniture, slots and
/// niches are less. Costs the cells of the opening's box and as far around it.
bool leads_to_unknown(const grid::DenseMap& map, const Opening& opening, const GoalParams& params);

/// The nodes of a skeleton that have no goal yet, by their rows: who looks for one that is near need not look
/// at all.
class FreeNodes {
 public:
  explicit FreeNodes(const places::Skeleton& skeleton);

  /// Calls f(number, node) for those in the rows [low, high].
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
  std::vector<Row> rows_;  ///< ascending, and by number in each
  std::vector<bool> taken_;
};

/// Steering: to the nearest node of the skeleton within node_reach_m that has room, is seen from the opening
/// and is one of `nodes` (from which it is taken); else up the distance field until clear_m or the axis.
/// Where that ends too narrow, the nearest cell through free space with robot_radius_m of clearance; nothing
/// when there is none within reach.
std::optional<types::Vector2> steer(const GoalInput& input, const Opening& opening, const GoalParams& params,
                                    FreeNodes& nodes);

/// Centroid filter over the goals of one place: what is nearer to the centroid than centroid_ratio of the
/// half extent is dropped where another goal of the place is further out, and near enough to stand in for it.
/// Of a place more than twice as long as wide, what stands on a long side counts as at that side's midpoint,
/// where the paper has it.
void drop_near_centroid(const places::PlaceMap& places, std::span<Goal> goals_of_place,
                        const GoalParams& params);

/// Few accepted goals that stand in for all: a goal stands in for those within separation_m, and within
/// in_sight_m where they see each other: who is at the one sees what the other is for. Greedy set cover: the
/// goal that stands in for most that nobody stands in for yet, of several the one with the widest opening.
/// Costs the goals squared.
void drop_duplicates(const grid::DenseMap& map, std::span<Goal> goals, const GoalParams& params);

/// Is everything free on the straight line between two cells' centres?
bool sees(const grid::DenseMap& map, grid::CellIndex a, grid::CellIndex b);

/// Pose-history filter: has a robot been there? For an opening of less than twice the least width one pose
/// within visited_radius_m is enough (paper: partial views through openings that a robot cannot enter). For
/// a wider one the paths, a robot's each, must go 1.2 times that far within it: a start with unknown space in
/// the scanner's blind sector behind the robot must not count as a visit.
bool is_visited(const Goal& goal, std::span<const std::vector<types::Vector2>> visited,
                const GoalParams& params);

}  // namespace topo::goals

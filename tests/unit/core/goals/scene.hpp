// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rapidcheck.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/goals/essential_goals.hpp"
#include "core/places/segmentation/segment_places.hpp"
#include "core/places/skeleton/skeleton.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::goals {

/// A room, and behind its whole upper side a pocket of unknown space with walls around it.
inline grid::DenseMap room_with_pocket(int width, int depth) {
  places::DrawnMap drawn(width + 20, depth + 40);
  drawn.occupied(5, 5, width + 9, depth + 29).free(7, 7, width + 7, 27);
  return drawn.fill(7, 27, width + 7, 27 + depth, grid::CellState::kUnknown).map();
}

/// A map with all that goals are made from.
struct Scene {
  explicit Scene(const places::DrawnMap& drawn) : Scene(drawn.map()) {}
  explicit Scene(grid::DenseMap of)
      : map(std::move(of)),
        clearance_m(grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown)),
        skeleton(places::skeletonise(map, clearance_m)),
        places(places::segment_places(map, clearance_m, skeleton, {}, 0.0)) {}

  [[nodiscard]] GoalInput input(std::span<const std::vector<types::Vector2>> visited = {}) const {
    return {map, clearance_m, skeleton, places, continued, visited};
  }
  [[nodiscard]] GoalSet goals(std::span<const std::vector<types::Vector2>> visited = {}) const {
    return essential_goals(input(visited));
  }

  grid::DenseMap map;
  std::vector<float> clearance_m;
  places::Skeleton skeleton;
  places::PlaceMap places;
  std::vector<types::Segment> continued;  ///< walls
};

/// A room with patches of the three states in it.
inline grid::DenseMap random_room(int side_max) {
  const int width = *rc::gen::inRange(12, side_max), height = *rc::gen::inRange(12, side_max);
  grid::DenseMap map = places::DrawnMap(width, height).free(2, 2, width - 2, height - 2).map();
  places::draw_patches(map, *rc::gen::inRange(0, 16), 14);
  return map;
}

/// A point on a lattice of 1 cm within `reach_m` of the origin along either axis.
inline types::Vector2 random_point(double reach_m) {
  const int reach = static_cast<int>(100.0 * reach_m);
  return {0.01 * *rc::gen::inRange(-reach, reach + 1), 0.01 * *rc::gen::inRange(-reach, reach + 1)};
}

inline std::vector<std::vector<types::Vector2>> random_paths(double reach_m) {
  std::vector<std::vector<types::Vector2>> paths(*rc::gen::inRange<std::size_t>(0, 4));
  for (std::vector<types::Vector2>& path : paths)
    for (int k = *rc::gen::inRange(0, 8); k > 0; --k) path.push_back(random_point(reach_m));
  return paths;
}

/// Steps from the nearest of some free cells to every cell, over free cells and their four sides, or their
/// eight neighbours; -1 where none leads to.
inline std::vector<int> steps_from(const grid::DenseMap& map, std::span<const std::uint32_t> starts,
                                   bool corners) {
  std::vector<int> steps(map.cells.size(), -1);
  std::vector<grid::CellIndex> queue;
  const auto visit = [&](grid::CellIndex c, int step) {
    if (map.state(c) != grid::CellState::kFree || steps[map.index(c)] >= 0) return;
    steps[map.index(c)] = step;
    queue.push_back(c);
  };
  for (const std::uint32_t i : starts) visit(map.cell(i), 0);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const grid::CellIndex c = queue[next];
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (corners || dx == 0 || dy == 0) visit({c.x + dx, c.y + dy}, steps[map.index(c)] + 1);
  }
  return steps;
}

}  // namespace topo::goals

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/steering.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "core/goals/filters.hpp"
#include "core/goals/frontiers.hpp"
#include "tests/unit/core/goals/scene.hpp"

namespace topo::goals {
namespace {

using grid::CellIndex;
using grid::CellState;

double clear_at(const Scene& scene, CellIndex c) {
  return static_cast<double>(scene.clearance_m[scene.map.index(c)]);
}

TEST(NearestRoom, IsTheFewestStepsAwayOverFreeCells) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene(random_room(70));
    GoalParams params;
    params.robot_radius_m = 0.05 * *rc::gen::inRange(2, 10);
    for (const Frontier& frontier : find_frontiers(scene.map, 0.0)) {
      const std::vector<int> steps = steps_from(scene.map, frontier.cells, false);
      int fewest = INT32_MAX;
      for (std::size_t i = 0; i < steps.size(); ++i) {
        const bool has_room = static_cast<double>(scene.clearance_m[i]) >= params.robot_radius_m;
        if (steps[i] >= 0 && has_room) fewest = std::min(fewest, steps[i]);
      }
      const auto room = nearest_room(scene.input(), frontier.cells, params);
      const int found = room ? steps[scene.map.index(*room)] : -1;
      if (room) RC_ASSERT(clear_at(scene, *room) >= params.robot_radius_m && found >= 0);
      // A way of up to 20 steps stays within the first window, and so none is shorter.
      if (fewest <= 20) RC_ASSERT(found == fewest);
      if (fewest == INT32_MAX) RC_ASSERT(!room);
    }
  }));
}

TEST(FreeNodes, AreThoseOfTheRowsThatWereNotTaken) {
  EXPECT_TRUE(rc::check([] {
    places::Skeleton skeleton;
    for (int n = *rc::gen::inRange(0, 30); n > 0; --n) {
      skeleton.nodes.emplace_back();
      skeleton.nodes.back().cell = {*rc::gen::inRange(-9, 9), *rc::gen::inRange(-9, 9)};
    }
    FreeNodes nodes(skeleton);
    std::vector<bool> taken(skeleton.nodes.size(), false);
    for (std::uint32_t n = 0; n < taken.size(); ++n) {
      if (*rc::gen::inRange(0, 3) != 0) continue;
      nodes.take(n);
      taken[n] = true;
    }
    const int low = *rc::gen::inRange(-12, 12), high = *rc::gen::inRange(-12, 12);
    std::vector<std::uint32_t> expected, found;
    for (std::uint32_t n = 0; n < taken.size(); ++n) {
      const int y = skeleton.nodes[n].cell.y;
      if (!taken[n] && y >= low && y <= high) expected.push_back(n);
    }
    nodes.for_each_in_rows(low, high, [&](std::uint32_t n, const places::SkeletonNode& node) {
      RC_ASSERT(&node == &skeleton.nodes[n]);
      found.push_back(n);
    });
    std::ranges::sort(found);
    RC_ASSERT(found == expected);
  }));
}

/// The free nodes that an opening's goal may be steered to, nearest first.
std::vector<std::uint32_t> nodes_for(const Scene& scene, CellIndex from, const GoalParams& params) {
  std::vector<std::uint32_t> near;
  const auto away_m = [&](std::uint32_t n) {
    return (scene.map.centre_of(scene.skeleton.nodes[n].cell) - scene.map.centre_of(from)).norm();
  };
  for (std::uint32_t n = 0; n < scene.skeleton.nodes.size(); ++n) {
    const CellIndex cell = scene.skeleton.nodes[n].cell;
    if (away_m(n) < params.node_reach_m && clear_at(scene, cell) >= params.robot_radius_m &&
        sees(scene.map, from, cell))
      near.push_back(n);
  }
  std::ranges::stable_sort(near, {}, away_m);
  return near;
}

TEST(Steer, GoesToTheNodesOneAfterTheOther) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene(random_room(70));
    const GoalParams params;
    for (const Opening& opening : find_openings(scene.input(), params)) {
      const auto room = nearest_room(scene.input(), opening.cells, params);
      if (!room) continue;
      FreeNodes nodes(scene.skeleton);
      for (const std::uint32_t n : nodes_for(scene, scene.map.cell(opening.middle), params)) {
        const types::Vector2 p = steer(scene.input(), opening, *room, params, nodes);
        RC_ASSERT(p == scene.map.centre_of(scene.skeleton.nodes[n].cell));
      }
    }
  }));
}

TEST(Steer, WithoutNodesEndsClearOnTheAxisOrAtTheStand) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene(random_room(70));
    const GoalParams params;
    const places::Skeleton no_nodes;
    for (const Opening& opening : find_openings(scene.input(), params)) {
      const auto room = nearest_room(scene.input(), opening.cells, params);
      if (!room) continue;
      FreeNodes nodes(no_nodes);
      const CellIndex end = scene.map.cell_at(steer(scene.input(), opening, *room, params, nodes));
      RC_ASSERT(scene.map.state(end) == CellState::kFree);
      RC_ASSERT(clear_at(scene, end) >= params.robot_radius_m);
      bool is_top = true;
      for (const CellIndex by : grid::kNeighbours)
        is_top = is_top && clear_at(scene, {end.x + by.x, end.y + by.y}) <= clear_at(scene, end);
      RC_ASSERT(clear_at(scene, end) >= params.clear_m || scene.skeleton.on[scene.map.index(end)] || is_top ||
                end == *room);
    }
  }));
}

}  // namespace
}  // namespace topo::goals

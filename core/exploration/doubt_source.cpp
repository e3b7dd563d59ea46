// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/exploration/sources.hpp"
#include "core/grid/distance.hpp"
#include "core/grid/nearest_reachable.hpp"
#include "core/travel/closed_way.hpp"
#include "core/travel/islands.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

/// The frontiers that may lead on, of those that the robot does not wholly reach.
std::vector<goals::Frontier> shut_off(const Situation& situation, const travel::RouteMap& map,
                                      const ExplorationParams& params) {
  std::vector<goals::Frontier> found = goals::find_frontiers(map.map(), params.frontier_min_m);
  std::erase_if(found, [&](const goals::Frontier& frontier) {
    const std::uint32_t middle = goals::middle_of(map.map(), frontier.cells);
    return !std::isinf(map.field().cost_m[middle]) ||
           chance_of(frontier, map.map(), situation) < params.ending.look_again_chance;
  });
  return found;
}

/// The map and its travel field if nothing stood there that stands free.
struct Opened {
  explicit Opened(const travel::RouteMap& map)
      : open(travel::without_islands(map.map(), map.params().island_m)),
        clearance_m(grid::clearance_m(open, grid::Boundary::kOccupiedOrUnknown)),
        field(grid::travel_field(open, clearance_m, map.field().start, map.rules())) {}
  grid::DenseMap open;
  std::vector<float> clearance_m;
  grid::TravelField field;
};

/// The cell to which the robot could go to see a part of the frontier that it sees from nowhere now.
std::optional<grid::CellIndex> gained(const goals::Frontier& frontier, const travel::RouteMap& map,
                                      const Opened& opened, double reach_m) {
  for (const std::uint32_t index : frontier.cells) {
    const grid::CellIndex cell = opened.open.cell(index);
    if (grid::nearest_reachable(map.map(), map.field(), cell, reach_m)) continue;
    if (const auto there = grid::nearest_reachable(opened.open, opened.field, cell, reach_m)) return there;
  }
  return std::nullopt;
}

/// Where to look at what may be gone: from the places at which routes to the frontiers that are shut off
/// are closed by what stands free.
std::vector<Vector2> before_islands(const Situation& situation, const travel::RouteMap& map,
                                    const ExplorationParams& params) {
  std::vector<Vector2> places;
  const std::vector<goals::Frontier> frontiers = shut_off(situation, map, params);
  if (frontiers.empty()) return places;
  const Opened opened(map);
  for (const goals::Frontier& frontier : frontiers) {
    const auto there = gained(frontier, map, opened, params.candidate.cell_reach_m);
    if (!there) continue;
    std::vector<Vector2> back;
    for (const grid::CellIndex cell : grid::route_to(opened.open, opened.field, *there))
      back.push_back(opened.open.centre_of(cell));
    std::ranges::reverse(back);
    if (const auto way = travel::closed_way(map.map(), map.field(), back, params.homing.look_from_m))
      places.push_back(way->look_from);
  }
  return places;
}

/// All of them, the pursued one first.
std::vector<Vector2> all_places(const Situation& situation, const travel::RouteMap& map,
                                const Pursuit& pursuit, const ExplorationParams& params) {
  std::vector<Vector2> places;
  if (pursuit.goal && pursuit.id.source == Source::kDoubt) places.push_back(pursuit.goal->p_map);
  places.insert(places.end(), situation.doubted.begin(), situation.doubted.end());
  if (const auto way = travel::closed_way(map.map(), map.field(), travel::positions_of(situation.driven),
                                          params.homing.look_from_m))
    places.push_back(way->look_from);
  const std::vector<Vector2> islands = before_islands(situation, map, params);
  places.insert(places.end(), islands.begin(), islands.end());
  return places;
}

}  // namespace

std::vector<Candidate> doubted_candidates(const Situation& situation, const travel::RouteMap& map,
                                          const Pursuit& pursuit, std::span<const Vector2> looked_again,
                                          const ExplorationParams& params) {
  std::vector<goals::Goal> places;
  const auto is_beside = [&](const Vector2& a, const Vector2& b) {
    return (a - b).norm() < params.ending.looked_again_m;
  };
  for (const Vector2& place : all_places(situation, map, pursuit, params)) {
    const bool was_there =
        std::ranges::any_of(looked_again, [&](const Vector2& p) { return is_beside(p, place); });
    const bool is_there =
        std::ranges::any_of(places, [&](const goals::Goal& g) { return is_beside(g.p_map, place); });
    if (!was_there && !is_there) places.push_back({.p_map = place, .opening = place});
  }
  const Reach reach{map.map(), map.clearance_m(), map.field(), map.rules().radius_m};
  bool cut_off = false;
  return candidates_of(proposed_by(Source::kDoubt, places), reach, DeferredGoals{}, situation.T_map_base,
                       situation.now, params.candidate, cut_off);
}

}  // namespace topo::exploration

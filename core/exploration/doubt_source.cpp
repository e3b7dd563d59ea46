// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>

#include "core/exploration/sources.hpp"
#include "core/grid/distance.hpp"
#include "core/grid/nearest_reachable.hpp"
#include "core/travel/closed_way.hpp"
#include "core/travel/islands.hpp"
#include "core/travel/travel_map.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

/// The cells of frontiers that may lead on, of each those that the robot sees from nowhere near.
std::vector<std::vector<grid::CellIndex>> unseen_parts(const Situation& situation,
                                                       const travel::RouteMap& map,
                                                       const ExplorationParams& params) {
  std::vector<std::vector<grid::CellIndex>> parts;
  for (const goals::Frontier& frontier : goals::find_frontiers(map.map(), params.frontier_min_m)) {
    std::vector<grid::CellIndex> part;
    for (const std::uint32_t index : frontier.cells) {
      const grid::CellIndex cell = map.map().cell(index);
      if (!grid::nearest_reachable(map.map(), map.field(), cell, params.candidate.cell_reach_m))
        part.push_back(cell);
    }
    if (!part.empty() && chance_of(frontier, map.map(), situation) >= params.ending.look_again_chance)
      parts.push_back(std::move(part));
  }
  return parts;
}

/// The map and its travel field if nothing stood there that stands free.
struct Opened {
  explicit Opened(const travel::RouteMap& map)
      : open(travel::without_islands(map.map(), map.params().island_m)) {
    travel::apply_limits(open, map.area());
    clearance_m = grid::clearance_m(open, grid::Boundary::kOccupiedOrUnknown);
    field = grid::travel_field(open, clearance_m, map.field().start, map.rules());
  }
  grid::DenseMap open;
  std::vector<float> clearance_m;
  grid::TravelField field;
};

/// True when something that stands free is at a place.
bool has_island(const Vector2& p_map, double within_m, const travel::RouteMap& map, const Opened& opened) {
  const Vector2 reach(within_m, within_m);
  const grid::CellIndex low = map.map().cell_at(p_map - reach), high = map.map().cell_at(p_map + reach);
  for (std::int32_t y = low.y; y <= high.y; ++y) {
    for (std::int32_t x = low.x; x <= high.x; ++x) {
      if (map.map().state({x, y}) == grid::CellState::kOccupied &&
          opened.open.state({x, y}) == grid::CellState::kFree)
        return true;
    }
  }
  return false;
}

/// The way back from where the robot would see the nearest of these cells, if what stands free had gone;
/// empty when it would see none.
std::vector<Vector2> way_back(std::span<const grid::CellIndex> part, const Opened& opened, double reach_m) {
  std::vector<Vector2> back;
  for (const grid::CellIndex cell : part) {
    const auto there = grid::nearest_reachable(opened.open, opened.field, cell, reach_m);
    if (!there) continue;
    for (const grid::CellIndex on : grid::route_to(opened.open, opened.field, *there))
      back.push_back(opened.open.centre_of(on));
    std::ranges::reverse(back);
    break;
  }
  return back;
}

/// Where to look at what may be gone: from the places at which routes to frontiers are closed by what stands
/// free.
std::vector<Vector2> before_islands(const Situation& situation, const travel::RouteMap& map,
                                    const ExplorationParams& params) {
  std::vector<Vector2> places;
  const auto parts = unseen_parts(situation, map, params);
  if (parts.empty()) return places;
  const Opened opened(map);
  for (const std::vector<grid::CellIndex>& part : parts) {
    const auto way =
        travel::closed_way(map.map(), map.field(), way_back(part, opened, params.candidate.cell_reach_m),
                           params.homing.look_from_m);
    if (way && has_island(way->closed_at, map.params().island_m, map, opened))
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
  if (const auto way = travel::closed_way(map.map(), map.field(),
                                          travel::positions_of(situation.driven, map.params().keyframe_gap_m),
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

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// What travelling costs (DESIGN "Exploration": one clearance-aware wavefront, unknown space forbidden).
struct TravelRules {
  double radius_m = 0.33;     ///< cells with less clearance are closed: the disc that the robot needs
  double preferred_m = 0.75;  ///< with more clearance than this a metre costs one metre
  double crowding = 3.0;      ///< extra cost of a metre at `radius_m`; falls linearly to 0 at preferred_m
  double start_m = 0.60;      ///< within this of the start, cells with too little clearance may be left
};

/// The cells around a cell, counter-clockwise from +x: straight ones have even numbers.
inline constexpr std::array<CellIndex, 8> kNeighbours{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Cost of the cheapest way from the start to every cell, in metres of open travel; infinity where there is
/// none. As long as map.cells.
struct TravelField {
  CellIndex start;
  std::vector<float> cost_m;
  std::vector<std::uint8_t> step;  ///< how the cell was entered: 0..7, the neighbour it came from; 255: none
};

/// Dijkstra over eight neighbours, with costs in a bucket queue. A step costs its length times the mean of
/// what a metre costs at both ends, so a way costs the same in both directions. `clearance_m` as long as
/// map.cells; where it is below `rules.radius_m` the robot cannot be, apart from the surroundings of the
/// start: a robot that stands too near to something may leave, over free cells within rules.start_m that are
/// no nearer to something than it is now (by more than a cell), and over whatever is not occupied below its
/// own footprint. There, too, closeness costs, the more the closer. A step between two occupied cells that
/// meet at a corner is none. Linear in the cells that are reached. Deterministic. A start outside the map
/// reaches nothing.
TravelField travel_field(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
                         const TravelRules& rules);

/// The way to a cell, from the start on, as cells; empty when it cannot be reached.
std::vector<CellIndex> route_to(const DenseMap& map, const TravelField& field, CellIndex goal);

/// The reachable cell nearest to `goal` (straight line) within `within_m`; the goal itself when reachable.
std::optional<CellIndex> nearest_reachable(const DenseMap& map, const TravelField& field, CellIndex goal,
                                           double within_m);

}  // namespace topo::grid

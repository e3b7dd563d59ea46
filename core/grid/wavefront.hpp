// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/grid/cell_run.hpp"
#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// Cost of travel (DESIGN "Exploration": one clearance-aware wavefront, unknown space forbidden).
struct TravelRules {
  double radius_m = 0.297;    ///< turning disc of a P3-DX; the robot cannot turn with less clearance
  double tight_m = 0.297;     ///< cells with less clearance are closed
  double tightness = 100.0;   ///< extra cost of a metre below `radius_m`: another route is mostly cheaper
  double preferred_m = 0.72;  ///< with more clearance than this a metre costs one metre
  double crowding = 3.0;      ///< extra cost of a metre at `radius_m`; falls linearly to 0 at preferred_m
  double start_m = 0.60;      ///< within this distance of the start, tight cells may be left
};

/// Neighbours of a cell, counter-clockwise from +x; straight ones have even indices.
inline constexpr std::array<CellIndex, 8> kNeighbours{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Cost of the cheapest route from the start to every cell, in metres of open travel; infinity where there is
/// none. Arrays have the size of map.cells.
struct TravelField {
  /// Placeholder for a cost: a route exists, and the paused search has not found it yet.
  static constexpr float kLater = std::numeric_limits<float>::max();

  CellIndex start;
  std::vector<float> cost_m;
  std::vector<std::uint8_t> step;  ///< neighbour (0..7) from which the cell was entered; 255: none
  std::vector<CellRun> written;    ///< runs that a search may have changed; the next search clears only these
  std::span<const float> clearance_m;  ///< used by the search, borrowed; empty: no cell is tight
  float radius_m = 0.0F;               ///< TravelRules::radius_m

  /// True when the robot can reach the cell and turn there; in a tight passage it can only drive on.
  [[nodiscard]] bool can_stay_at(std::size_t index) const {
    return cost_m[index] < std::numeric_limits<float>::infinity() &&
           (clearance_m.empty() || clearance_m[index] >= radius_m);
  }
};

/// Dijkstra over eight neighbours, with costs in a bucket queue. A step costs its length times the mean of
/// the costs of a metre at both ends, so a route costs the same in both directions. `clearance_m` has the
/// size of map.cells. Cells with a clearance below `rules.tight_m` are closed, except around the start: a
/// robot with too little clearance may leave over free cells within rules.start_m whose clearance is no
/// smaller than its own (by more than a cell), and over all cells that are not occupied within
/// rules.radius_m. Inflation applies there as well. Outside these cells, a step may not cut the corner of an
/// occupied cell. Linear in the reached cells, after one pass over the map. Deterministic. A start outside
/// the map reaches nothing.
TravelField travel_field(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
                         const TravelRules& rules);

/// travel_field in stages, for repeated use on one thread. A caller that needs the nearest of several cells
/// need not wait for the rest of the map. Allocates nothing once its arrays and the field's have grown to the
/// map.
class TravelSearch {
 public:
  TravelSearch();
  ~TravelSearch();
  TravelSearch(const TravelSearch&) = delete;
  TravelSearch& operator=(const TravelSearch&) = delete;

  /// As travel_field. The caller must not change `map`, `clearance_m` or `field` until the next begin().
  void begin(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
             const TravelRules& rules, TravelField& field);

  /// Continues until all costs below `bound_m` are final, with the steps of their routes. The other costs are
  /// infinite where no route exists, and otherwise at least settled_m(): TravelField::kLater, or the cost of
  /// a route that need not be the cheapest. HUGE_VAL: to the end.
  void settle(double bound_m);

  /// As settle(), at lower cost: costs that are not final have no meaning.
  void advance(double bound_m);

  /// Costs below this are final; infinity when all are.
  [[nodiscard]] double settled_m() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Route to a cell as cells from the start on; empty when the cell cannot be reached.
std::vector<CellIndex> route_to(const DenseMap& map, const TravelField& field, CellIndex goal);

}  // namespace topo::grid

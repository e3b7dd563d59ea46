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

/// What travelling costs (DESIGN "Exploration": one clearance-aware wavefront, unknown space forbidden).
struct TravelRules {
  double radius_m =
      0.297;               ///< the disc in which a P3-DX turns: with less clearance it passes through, or not
  double tight_m = 0.297;  ///< cells with less clearance are closed
  double tightness = 100.0;   ///< extra cost of a metre below `radius_m`: another way is mostly better
  double preferred_m = 0.72;  ///< with more clearance than this a metre costs one metre
  double crowding = 3.0;      ///< extra cost of a metre at `radius_m`; falls linearly to 0 at preferred_m
  double start_m = 0.60;      ///< within this of the start, cells with too little clearance may be left
};

/// The cells around a cell, counter-clockwise from +x: straight ones have even numbers.
inline constexpr std::array<CellIndex, 8> kNeighbours{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Cost of the cheapest way from the start to every cell, in metres of open travel; infinity where there is
/// none. As long as map.cells.
struct TravelField {
  /// In place of a cost: there is a way, and a search that was paused has not found it yet.
  static constexpr float kLater = std::numeric_limits<float>::max();

  CellIndex start;
  std::vector<float> cost_m;
  std::vector<std::uint8_t> step;  ///< how the cell was entered: 0..7, the neighbour it came from; 255: none
  std::vector<CellRun> written;    ///< where a search may have set something: the next one clears no more
  std::span<const float> clearance_m;  ///< what was searched by, borrowed; empty: nothing is tight
  float radius_m = 0.0F;               ///< TravelRules::radius_m

  /// Can the robot get to a cell and do there what it likes? In a tight passage it can but go on.
  [[nodiscard]] bool can_stay_at(std::size_t index) const {
    return cost_m[index] < std::numeric_limits<float>::infinity() &&
           (clearance_m.empty() || clearance_m[index] >= radius_m);
  }
};

/// Dijkstra over eight neighbours, with costs in a bucket queue. A step costs its length times the mean of
/// what a metre costs at both ends, so a way costs the same in both directions. `clearance_m` as long as
/// map.cells; where it is below `rules.tight_m` the robot cannot be, apart from the surroundings of the
/// start: a robot that stands too near to something may leave, over free cells within rules.start_m that are
/// no nearer to something than it is now (by more than a cell), and over whatever is not occupied below its
/// own footprint. There, too, closeness costs, the more the closer. A step between two occupied cells that
/// meet at a corner is none. Linear in the cells that are reached. Deterministic. A start outside the map
/// reaches nothing.
TravelField travel_field(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
                         const TravelRules& rules);

/// travel_field in stages, and over and over, on one thread. Whoever wants the nearest of several cells need
/// not wait for the rest of the building. Once its arrays and the field's are as long as the map, it
/// allocates nothing.
class TravelSearch {
 public:
  TravelSearch();
  ~TravelSearch();
  TravelSearch(const TravelSearch&) = delete;
  TravelSearch& operator=(const TravelSearch&) = delete;

  /// As travel_field. `map`, `clearance_m` and `field` must stay as they are until the next begin().
  void begin(const DenseMap& map, std::span<const float> clearance_m, CellIndex start,
             const TravelRules& rules, TravelField& field);

  /// Goes on until all costs below `bound_m` are final, with the steps of their ways, and the others are
  /// infinite where no way leads and no less than settled_m() elsewhere (TravelField::kLater, or that of a
  /// way which need not be the cheapest). HUGE_VAL: to the end.
  void settle(double bound_m);

  /// As settle(), for less: nothing is said of costs that are not final.
  void advance(double bound_m);

  /// Costs below are final; infinity when all are.
  [[nodiscard]] double settled_m() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The way to a cell, from the start on, as cells; empty when it cannot be reached.
std::vector<CellIndex> route_to(const DenseMap& map, const TravelField& field, CellIndex goal);

}  // namespace topo::grid

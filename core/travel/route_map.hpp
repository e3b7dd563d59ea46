// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/clearance_update.hpp"
#include "core/grid/dense_map.hpp"
#include "core/grid/occupancy_grid.hpp"
#include "core/grid/wavefront.hpp"
#include "core/travel/coarse_map.hpp"
#include "core/travel/far_route.hpp"
#include "core/travel/params.hpp"
#include "core/travel/travel_map.hpp"
#include "core/types/area_limits.hpp"
#include "core/types/keyframe_pose.hpp"

namespace topo::travel {

/// Points in map that no keyframe contains, and points where an obstacle of the map is gone.
struct Overlays {
  std::vector<types::Vector2> echoed;        ///< detected by sonar or touch
  std::vector<types::Vector2> seen_now;      ///< detected by the newest scan
  std::vector<types::Vector2> stuck_on;      ///< where the robot got stuck
  std::vector<types::Vector2> going_at;      ///< team-mates that will move on
  std::vector<types::Vector2> seen_through;  ///< where the newest scan sees to be free what is occupied
};

/// The map for travel and the searches on it. Searches run as far as the calls of one period need and are
/// kept for that period. The result of a call does not depend on the other calls, but for costs beyond
/// settled_m(), which are unknown until a call has settled them: reachable_cell() decides among equals by
/// them. One thread.
class RouteMap {
 public:
  RouteMap(const grid::TravelRules& rules, const types::AreaLimits& area, const RouteMapParams& params = {})
      : rules_(rules), area_(area), params_(params) {}

  /// The area limits from now on. True when they are others: the next take() prepares the map anew.
  bool limit(const types::AreaLimits& area);
  [[nodiscard]] const types::AreaLimits& area() const { return area_; }
  /// Takes a generation of the map. Costs nothing when the revision is the current one.
  void take(std::uint64_t revision, const grid::OccupancyGrid& grid, const DrivenWays& ways);
  /// Begins the searches of a period at the robot's pose, with the clearance from map and overlays. Driven
  /// paths stay open where only noise or faint evidence closes them. What is seen to be free is free in map()
  /// and clearance_m() until the next take() or begin().
  void begin(const types::KeyframePose& here, const DrivenWays& ways, const Overlays& overlays);

  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  [[nodiscard]] const grid::DenseMap& map() const { return map_; }
  /// Of map(), without the overlays; the size of map().cells.
  [[nodiscard]] const std::vector<float>& clearance_m() const { return clearance_.clearance_m(); }
  [[nodiscard]] double known_m2() const { return known_m2_; }  ///< area of the free cells
  [[nodiscard]] const grid::TravelRules& rules() const { return rules_; }
  [[nodiscard]] const RouteMapParams& params() const { return params_; }

  /// Costs from the robot's position. Costs below settled_m() are final.
  [[nodiscard]] const grid::TravelField& field() const { return field_; }
  [[nodiscard]] double settled_m() const { return search_.settled_m(); }
  void settle(double bound_m) { search_.settle(bound_m); }

  /// The map for travel in wider cells, and the complete field on it; computed at the first call of a period.
  const CoarseMap& coarse();
  const grid::TravelField& coarse_field();

  /// The smoothed route to a cell, in map; empty when there is none.
  [[nodiscard]] std::vector<types::Vector2> route_to(grid::CellIndex target);
  /// The reachable cell nearest to a point; prefers a cell at which the robot can turn.
  [[nodiscard]] std::optional<grid::CellIndex> reachable_cell(const types::Vector2& p_map);
  /// The narrowest point of the next stretch of a route where, by the map, the robot cannot turn; nothing
  /// when it can turn everywhere. Points at the robot itself do not count.
  [[nodiscard]] std::optional<types::Vector2> tight_ahead(std::span<const types::Vector2> route,
                                                          const types::Vector2& here) const;

 private:
  void close_again();
  void open(const types::Vector2& here, const Overlays& overlays);
  [[nodiscard]] std::vector<types::Vector2> beside_opened(std::span<const types::Vector2> obstacles) const;
  [[nodiscard]] std::vector<grid::CellIndex> cells_to(grid::CellIndex target);
  void inflate_mates(std::span<const types::Vector2> mates);

  grid::TravelRules rules_;
  types::AreaLimits area_;
  RouteMapParams params_;
  std::uint64_t revision_ = 0;
  grid::DenseMap map_;
  std::vector<std::size_t> opened_;        // cells of map_ that are free until the next begin()
  grid::ClearanceUpdate clearance_;        // of map_
  std::vector<float> travel_clearance_m_;  // with the overlays
  double known_m2_ = 0.0;
  grid::TravelSearch search_;
  grid::TravelField field_;
  bool has_coarse_ = false;  // of this period
  CoarseMap coarse_;
  grid::TravelSearch coarse_search_;
  grid::TravelField coarse_field_;
  FarRoute far_route_;
};

/// Area within a square of half side `reach_m` that is unknown on `then` and known on `now`, m2.
double newly_known_m2(const grid::DenseMap& then, const grid::OccupancyGrid& now,
                      const types::Vector2& centre, double reach_m);

}  // namespace topo::travel

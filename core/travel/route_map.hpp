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

/// Points in map that no keyframe holds.
struct Overlays {
  std::vector<types::Vector2> echoed;    ///< heard by sonar, or touched
  std::vector<types::Vector2> seen_now;  ///< by the newest scan
  std::vector<types::Vector2> stuck_on;  ///< where the robot did not get on
  std::vector<types::Vector2> going_at;  ///< team-mates that will move on
};

/// The map for travelling and the searches on it. Searches go as far as the calls of one period need them and
/// are kept for that period; each call gives what it would give alone. One thread.
class RouteMap {
 public:
  RouteMap(const grid::TravelRules& rules, const types::AreaLimits& area, const RouteMapParams& params = {})
      : rules_(rules), area_(area), params_(params) {}

  /// A generation of the map. Costs nothing when the revision is the present one.
  void take(std::uint64_t revision, const grid::OccupancyGrid& grid, const DrivenWays& ways);
  /// Begins the searches of a period: clearance by the map and the overlays, from where the robot is.
  /// Driven ways stay open where only noise or faint evidence closes them.
  void begin(const types::KeyframePose& here, const DrivenWays& ways, const Overlays& overlays);

  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  [[nodiscard]] const grid::DenseMap& map() const { return map_; }
  /// By the map alone, as long as its cells.
  [[nodiscard]] const std::vector<float>& clearance_m() const { return clearance_.clearance_m(); }
  [[nodiscard]] double known_m2() const { return known_m2_; }  ///< free cells
  [[nodiscard]] const grid::TravelRules& rules() const { return rules_; }

  /// Costs from the robot. Those below settled_m() are final.
  [[nodiscard]] const grid::TravelField& field() const { return field_; }
  [[nodiscard]] double settled_m() const { return search_.settled_m(); }
  void settle(double bound_m) { search_.settle(bound_m); }

  /// The map for travelling in wider cells, and the whole field on it; made at the first call of a period.
  const CoarseMap& coarse();
  const grid::TravelField& coarse_field();

  /// The route to a cell, smoothed, in map; empty when there is none.
  [[nodiscard]] std::vector<types::Vector2> route_to(grid::CellIndex target);
  /// The reachable cell nearest to a point, one at which the robot can turn if there is one.
  [[nodiscard]] std::optional<grid::CellIndex> reachable_cell(const types::Vector2& p_map);
  /// Where the next stretch of a route is narrowest, if the map is too narrow there to turn in. The robot's
  /// own place does not count.
  [[nodiscard]] std::optional<types::Vector2> tight_ahead(std::span<const types::Vector2> route,
                                                          const types::Vector2& here) const;

 private:
  [[nodiscard]] std::vector<grid::CellIndex> cells_to(grid::CellIndex target);
  void inflate_mates(std::span<const types::Vector2> mates);

  grid::TravelRules rules_;
  types::AreaLimits area_;
  RouteMapParams params_;
  std::uint64_t revision_ = 0;
  grid::DenseMap map_;
  grid::ClearanceUpdate clearance_;        // of the map alone
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

/// Area within a square of half side `reach_m` that is unknown on the one map and known on the other, m2.
double newly_known_m2(const grid::DenseMap& then, const grid::OccupancyGrid& now,
                      const types::Vector2& centre, double reach_m);

}  // namespace topo::travel

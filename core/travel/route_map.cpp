// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/route_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/grid/free_runs.hpp"
#include "core/grid/nearest_reachable.hpp"
#include "core/grid/occupancy_grid.hpp"
#include "core/travel/path.hpp"

namespace topo::travel {
namespace {

using types::Vector2;

double free_area_m2(const grid::DenseMap& map) {
  std::size_t cells = 0;
  grid::for_each_free_run(map.cells, 0, map.cells.size(),
                          [&](std::size_t first, std::size_t end) { cells += end - first; });
  return static_cast<double>(cells) * map.resolution_m * map.resolution_m;
}

std::vector<Vector2> without_near(std::span<const Vector2> points, std::span<const Vector2> others,
                                  double within_m) {
  std::vector<Vector2> rest;
  std::ranges::copy_if(points, std::back_inserter(rest), [&](const Vector2& p) {
    return std::ranges::none_of(others, [&](const Vector2& o) { return (o - p).norm() < within_m; });
  });
  return rest;
}

}  // namespace

bool RouteMap::limit(const types::AreaLimits& area) {
  if (area == area_) return false;
  area_ = area;
  map_.cells.clear();
  opened_.clear();
  return true;
}

void RouteMap::take(std::uint64_t revision, const grid::OccupancyGrid& grid, const DrivenWays& ways) {
  close_again();
  if (revision == revision_ && !map_.cells.empty()) return;
  revision_ = revision;
  map_ = prepare_map(grid, ways, area_, rules_.radius_m, params_.map);
  clearance_.take(map_);
  known_m2_ = free_area_m2(map_);
}

/// What one decision saw to be free holds until the next.
void RouteMap::close_again() {
  if (opened_.empty()) return;
  for (const std::size_t index : opened_) map_.cells[index] = grid::CellState::kOccupied;
  opened_.clear();
  clearance_.take(map_);
}

/// The robot stands on cells that it was let onto while it saw them free, and no longer sees.
void RouteMap::open(const Vector2& here, const Overlays& overlays) {
  close_again();
  const std::vector<Vector2> seen_free =
      without_near(overlays.seen_through, overlays.echoed, rules_.radius_m);  // what a laser does not see
  opened_ =
      open_seen_through(map_, seen_free, area_, overlays.seen_now, params_.live_noise_m + map_.resolution_m);
  const std::vector<std::size_t> beneath =
      open_beneath(map_, here, params_.map.inner_share * rules_.radius_m, area_);
  opened_.insert(opened_.end(), beneath.begin(), beneath.end());
  if (!opened_.empty()) clearance_.take(map_);
}

void RouteMap::begin(const types::KeyframePose& here, const DrivenWays& ways, const Overlays& overlays) {
  const Vector2 here_map = here.T_map_base.se2().translation();
  open(here_map, overlays);
  travel_clearance_m_ = clearance_.clearance_m();
  lower_clearance(map_, overlays.echoed, rules_.preferred_m, travel_clearance_m_);
  const grid::CellIndex start = map_.cell_at(here_map);
  std::vector<types::KeyframePose> last_bit;  // driven since the last keyframe
  if (!ways.own.empty()) last_bit = {ways.own.back(), here};
  const auto keep_ways_open = [&](const TrailRules& rules) {
    keep_trail_open(map_, ways.own, start, rules, travel_clearance_m_);
    keep_trail_open(map_, last_bit, start, rules, travel_clearance_m_);
    for (const std::vector<types::KeyframePose>& way : ways.mates)
      keep_trail_open(map_, way, start, rules, travel_clearance_m_);
  };
  const double gap_m = params_.keyframe_gap_m;
  keep_ways_open({rules_.radius_m, 0.0, HUGE_VAL, gap_m});
  lower_clearance(map_, overlays.seen_now, rules_.preferred_m, travel_clearance_m_);
  // Beside what is opened an obstacle of the map may be nearer to a driven path than that path's rule allows.
  lower_clearance(map_, beside_opened(overlays.seen_now), rules_.preferred_m, travel_clearance_m_,
                  MapObstacles::kTake);
  // Noise must not close the path by which the robot came; the safety gate stops it before real obstacles
  // there.
  keep_ways_open({rules_.tight_m, rules_.tight_m - params_.live_noise_m, params_.live_range_m, gap_m});
  // An obstacle at which the robot got stuck also closes its own path: otherwise the same route would be
  // taken forever.
  lower_clearance(map_, overlays.stuck_on, rules_.preferred_m, travel_clearance_m_);
  inflate_mates(overlays.going_at);
  search_.begin(map_, travel_clearance_m_, start, rules_, field_);
  has_coarse_ = false;
}

/// Routes lead round moving team-mates where there is free space, and through their positions where there is
/// none.
void RouteMap::inflate_mates(std::span<const Vector2> mates) {
  const auto reach = static_cast<std::int32_t>(std::ceil(params_.mate_m / map_.resolution_m));
  const auto least_m = static_cast<float>(rules_.radius_m);
  for (const Vector2& mate : mates) {
    const grid::CellIndex centre = map_.cell_at(mate);
    for (std::int32_t dy = -reach; dy <= reach; ++dy) {
      for (std::int32_t dx = -reach; dx <= reach; ++dx) {
        const grid::CellIndex cell{centre.x + dx, centre.y + dy};
        if (!map_.contains(cell) || dx * dx + dy * dy > reach * reach) continue;
        float& clearance_m = travel_clearance_m_[map_.index(cell)];
        clearance_m = std::min(clearance_m, least_m);
      }
    }
  }
}

std::vector<Vector2> RouteMap::beside_opened(std::span<const Vector2> obstacles) const {
  std::vector<Vector2> beside;
  std::ranges::copy_if(obstacles, std::back_inserter(beside), [&](const Vector2& p) {
    return std::ranges::any_of(opened_, [&](std::size_t index) {
      return (map_.centre_of(map_.cell(index)) - p).norm() <= rules_.preferred_m;
    });
  });
  return beside;
}

const CoarseMap& RouteMap::coarse() {
  if (!has_coarse_) {
    has_coarse_ = true;
    coarse_ = coarser(map_, travel_clearance_m_, params_.coarse_doublings);
    const grid::CellIndex start = coarse_.map.cell_at(map_.centre_of(field_.start));
    coarse_search_.begin(coarse_.map, coarse_.clearance_m, start, rules_, coarse_field_);
    coarse_search_.settle(HUGE_VAL);
  }
  return coarse_;
}

const grid::TravelField& RouteMap::coarse_field() {
  (void)coarse();
  return coarse_field_;
}

/// A distant cell does not need a search of the whole building.
std::vector<grid::CellIndex> RouteMap::cells_to(grid::CellIndex target) {
  search_.settle(params_.near_m);
  if (static_cast<double>(field_.cost_m[map_.index(target)]) >= search_.settled_m()) {
    const CoarseMap& wide = coarse();
    std::vector<grid::CellIndex> cells = far_route_.find(map_, travel_clearance_m_, wide, coarse_field_,
                                                         field_.start, target, rules_, params_.far);
    if (!cells.empty()) return cells;
    search_.settle(HUGE_VAL);
  }
  return grid::route_to(map_, field_, target);
}

std::vector<Vector2> RouteMap::route_to(grid::CellIndex target) {
  return smooth_path(map_, travel_clearance_m_, cells_to(target), rules_.preferred_m, params_.path);
}

std::optional<grid::CellIndex> RouteMap::reachable_cell(const Vector2& p_map) {
  search_.settle(params_.aim_search_m);
  const grid::CellIndex cell = map_.cell_at(p_map);
  const auto stay = grid::nearest_to_stay_at(map_, field_, cell, params_.aim_beside_m);
  return stay ? stay : grid::nearest_reachable(map_, field_, cell, params_.aim_beside_m);
}

std::optional<Vector2> RouteMap::tight_ahead(std::span<const Vector2> route, const Vector2& here) const {
  std::optional<Vector2> narrowest;
  if (route.empty()) return narrowest;
  auto least_m = static_cast<float>(rules_.radius_m);
  double along_m = 0.0;
  for (std::size_t i = nearest_point(route, here, params_.path) + 1; i < route.size(); ++i) {
    along_m += (route[i] - route[i - 1]).norm();
    if (along_m >= params_.tight_ahead_m) break;
    const grid::CellIndex cell = map_.cell_at(route[i]);
    if (!map_.contains(cell) || (route[i] - here).norm() < rules_.radius_m) continue;
    const float clear_m = clearance_m()[map_.index(cell)];
    if (clear_m >= least_m) continue;
    narrowest = route[i];
    least_m = clear_m;
  }
  return narrowest;
}

double newly_known_m2(const grid::DenseMap& then, const grid::OccupancyGrid& now, const Vector2& centre,
                      double reach_m) {
  using grid::CellState;
  const Vector2 reach(reach_m, reach_m);
  const grid::CellIndex low = then.cell_at(centre - reach), high = then.cell_at(centre + reach);
  std::size_t cells = 0;
  for (std::int32_t y = low.y; y <= high.y; ++y) {
    for (std::int32_t x = low.x; x <= high.x; ++x)
      if (then.state({x, y}) == CellState::kUnknown && now.state({x, y}) != CellState::kUnknown) ++cells;
  }
  return static_cast<double>(cells) * then.resolution_m * then.resolution_m;
}

}  // namespace topo::travel

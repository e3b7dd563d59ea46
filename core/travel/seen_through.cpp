// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/seen_through.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/travel/islands.hpp"

namespace topo::travel {
namespace {

using types::Vector2;

/// A scan, from where the scanner is.
class View {
 public:
  View(const types::Scan& scan, const types::Se2& T_map_laser, const RouteMapParams& params, double cell_m)
      : scan_(scan),
        params_(params),
        T_laser_map_(T_map_laser.inverse()),
        half_m_(0.5 * std::numbers::sqrt2 * cell_m) {}

  /// True when all beams through a cell, and the next one on either side, hit something behind it. A beam
  /// without a return says nothing: black things give none.
  [[nodiscard]] bool passes(const Vector2& p_map) const {
    const Vector2 p = T_laser_map_ * p_map;
    const double away_m = p.norm();
    if (away_m > params_.live_range_m || away_m <= half_m_) return false;
    // A mirrored scanner counts down, and a sector may begin a turn away from (-pi, pi].
    const double middle_rad = static_cast<double>(scan_.angle_rad(scan_.checked_beams() / 2));
    const double angle_rad = middle_rad + types::wrap_angle(std::atan2(p.y(), p.x()) - middle_rad);
    const double half_rad = std::asin(half_m_ / away_m);
    const auto [low, high] =
        std::minmax({scan_.beam_at(angle_rad - half_rad), scan_.beam_at(angle_rad + half_rad)});
    const double first = std::floor(low), last = std::ceil(high);
    if (!(first >= 0.0) || !(last < static_cast<double>(scan_.beams))) return false;
    const auto ranges =
        scan_.ranges().subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first) + 1);
    return std::ranges::all_of(ranges, [&](float range_m) {
      return types::is_hit(range_m) && static_cast<double>(range_m) >= away_m + params_.live_behind_m;
    });
  }

 private:
  const types::Scan& scan_;
  const RouteMapParams& params_;
  types::Se2 T_laser_map_;
  double half_m_;
};

/// Points of driven ways near the robot, at most `step_m` apart.
std::vector<Vector2> ways_near(const Vector2& here, const DrivenWays& ways, const RouteMapParams& params,
                               double step_m) {
  std::vector<Vector2> points;
  const double within_m = params.live_range_m + params.keyframe_gap_m;
  const auto is_near = [&](const Vector2& end) { return (end - here).norm() <= within_m; };
  const auto take = [&](const Vector2& p) { points.push_back(p); };
  for_each_point(ways.own, params.keyframe_gap_m, step_m, is_near, take);
  for (std::span<const types::KeyframePose> way : ways.mates)
    for_each_point(way, params.keyframe_gap_m, step_m, is_near, take);
  return points;
}

/// The cells of a box, which need not lie within the map.
grid::DenseMap part_of(const grid::DenseMap& map, const grid::CellBox& box) {
  grid::DenseMap part;
  part.box = box;
  part.resolution_m = map.resolution_m;
  part.cells.reserve(static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()));
  for (std::int32_t y = box.min.y; y <= box.max.y; ++y)
    for (std::int32_t x = box.min.x; x <= box.max.x; ++x) part.cells.push_back(map.state({x, y}));
  return part;
}

}  // namespace

std::vector<Vector2> seen_through(const types::Scan& scan, const types::Se2& T_map_laser,
                                  const grid::DenseMap& map, const DrivenWays& ways,
                                  const RouteMapParams& params) {
  std::vector<Vector2> passed;
  const View view(scan, T_map_laser, params, map.resolution_m);
  const Vector2 reach(params.live_range_m, params.live_range_m);
  const Vector2 here = T_map_laser.translation();
  const grid::CellBox near{map.cell_at(here - reach), map.cell_at(here + reach)};
  for (std::int32_t y = near.min.y; y <= near.max.y; ++y) {
    for (std::int32_t x = near.min.x; x <= near.max.x; ++x) {
      const Vector2 p_map = map.centre_of({x, y});
      if (map.state({x, y}) == grid::CellState::kOccupied && view.passes(p_map)) passed.push_back(p_map);
    }
  }
  if (passed.empty()) return passed;
  // What is cut off at the border of this part is longer than an island, if it has a cell near the robot.
  const auto margin = static_cast<std::int32_t>(std::lround(params.island_m / map.resolution_m)) + 1;
  const grid::DenseMap open = without_islands(
      part_of(map, {{near.min.x - margin, near.min.y - margin}, {near.max.x + margin, near.max.y + margin}}),
      params.island_m);
  const std::vector<Vector2> on_ways = ways_near(here, ways, params, map.resolution_m);
  const auto is_on_a_way = [&](const Vector2& p_map) {
    return std::ranges::any_of(on_ways,
                               [&](const Vector2& p) { return (p - p_map).norm() <= map.resolution_m; });
  };
  std::erase_if(passed, [&](const Vector2& p_map) {
    return open.state(open.cell_at(p_map)) != grid::CellState::kFree && !is_on_a_way(p_map);
  });
  return passed;
}

}  // namespace topo::travel

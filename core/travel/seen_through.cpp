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
    const auto [low, high] = std::minmax({beam_at(angle_rad - half_rad), beam_at(angle_rad + half_rad)});
    const double first = std::floor(low), last = std::ceil(high);
    if (!(first >= 0.0) || !(last < static_cast<double>(scan_.beams))) return false;
    const auto ranges =
        scan_.ranges().subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first) + 1);
    return std::ranges::all_of(ranges, [&](float range_m) {
      return types::is_hit(range_m) && static_cast<double>(range_m) >= away_m + params_.live_behind_m;
    });
  }

 private:
  [[nodiscard]] double beam_at(double angle_rad) const {
    return (angle_rad - static_cast<double>(scan_.geometry.angle_min_rad)) /
           static_cast<double>(scan_.geometry.angle_increment_rad);
  }
  const types::Scan& scan_;
  const RouteMapParams& params_;
  types::Se2 T_laser_map_;
  double half_m_;
};

bool is_on_a_way(const Vector2& p_map, const DrivenWays& ways, const RouteMapParams& params, double cell_m) {
  bool is_on = false;
  const auto is_near = [&](const Vector2& end) { return (end - p_map).norm() <= params.keyframe_gap_m; };
  const auto look = [&](const Vector2& on_way) { is_on = is_on || (on_way - p_map).norm() <= cell_m; };
  for_each_point(ways.own, params.keyframe_gap_m, cell_m, is_near, look);
  for (std::span<const types::KeyframePose> way : ways.mates)
    for_each_point(way, params.keyframe_gap_m, cell_m, is_near, look);
  return is_on;
}

}  // namespace

std::vector<Vector2> seen_through(const types::Scan& scan, const types::Se2& T_map_laser,
                                  const grid::DenseMap& map, const DrivenWays& ways,
                                  const RouteMapParams& params) {
  std::vector<Vector2> passed;
  const View view(scan, T_map_laser, params, map.resolution_m);
  const Vector2 reach(params.live_range_m, params.live_range_m);
  const grid::CellIndex low = map.cell_at(T_map_laser.translation() - reach),
                        high = map.cell_at(T_map_laser.translation() + reach);
  for (std::int32_t y = std::max(low.y, map.box.min.y); y <= std::min(high.y, map.box.max.y); ++y) {
    for (std::int32_t x = std::max(low.x, map.box.min.x); x <= std::min(high.x, map.box.max.x); ++x) {
      const Vector2 p_map = map.centre_of({x, y});
      if (map.state({x, y}) == grid::CellState::kOccupied && view.passes(p_map)) passed.push_back(p_map);
    }
  }
  if (passed.empty()) return passed;
  const grid::DenseMap open = without_islands(map, params.island_m);
  std::erase_if(passed, [&](const Vector2& p_map) {
    return open.state(open.cell_at(p_map)) != grid::CellState::kFree &&
           !is_on_a_way(p_map, ways, params, map.resolution_m);
  });
  return passed;
}

}  // namespace topo::travel

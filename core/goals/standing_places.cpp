// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/standing_places.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/goals/filters.hpp"

namespace topo::goals {
namespace {

/// The stands of prospects, sorted by x for a search by position.
class Stands {
 public:
  Stands(const grid::DenseMap& map, std::span<const Prospect> prospects, double in_sight_m)
      : map_(map), in_sight_m_(in_sight_m) {
    for (std::uint32_t k = 0; k < prospects.size(); ++k)
      by_x_.push_back({map.centre_of(prospects[k].stand), prospects[k].stand, k});
    std::stable_sort(by_x_.begin(), by_x_.end(),
                     [](const Stand& a, const Stand& b) { return a.p_map.x() < b.p_map.x(); });
  }

  /// The viewpoint at a point with the prospects that it serves; `own` is served even out of sight.
  [[nodiscard]] StandingPlace place_at(const types::Vector2& p_map, std::optional<std::uint32_t> own) const {
    StandingPlace place{p_map, {}, 0.0, !own};
    const grid::CellIndex cell = map_.cell_at(p_map);
    const auto left_of = [](const Stand& stand, double x) { return stand.p_map.x() < x; };
    auto it = std::lower_bound(by_x_.begin(), by_x_.end(), p_map.x() - in_sight_m_, left_of);
    for (; it != by_x_.end() && it->p_map.x() <= p_map.x() + in_sight_m_; ++it) {
      const double away_m = (it->p_map - p_map).norm();
      if (it->prospect == own || away_m > in_sight_m_ || !sees(map_, it->cell, cell)) continue;
      place.serves.push_back(it->prospect);
      place.away_m += away_m;
    }
    if (own) place.serves.push_back(*own);
    if (!place.serves.empty()) place.away_m /= static_cast<double>(place.serves.size());
    std::sort(place.serves.begin(), place.serves.end());
    return place;
  }

 private:
  struct Stand {
    types::Vector2 p_map;
    grid::CellIndex cell;
    std::uint32_t prospect;
  };

  const grid::DenseMap& map_;
  double in_sight_m_;
  std::vector<Stand> by_x_;
};

}  // namespace

std::vector<StandingPlace> standing_places(const GoalInput& input, std::span<const Prospect> prospects,
                                           const GoalParams& params) {
  const Stands stands(input.map, prospects, params.in_sight_m);
  std::vector<StandingPlace> places;
  for (std::uint32_t k = 0; k < prospects.size(); ++k)
    places.push_back(stands.place_at(prospects[k].p_map, k));
  const auto step =
      static_cast<std::size_t>(std::max(1L, std::lround(params.axis_step_m / input.map.resolution_m)));
  const std::vector<std::uint32_t>& axis = input.skeleton.axis;
  for (std::size_t k = 0; k < axis.size(); k += step) {
    if (static_cast<double>(input.clearance_m[axis[k]]) < params.robot_radius_m) continue;
    StandingPlace place = stands.place_at(input.map.centre_of(input.map.cell(axis[k])), std::nullopt);
    if (place.serves.size() > 1) places.push_back(std::move(place));
  }
  return places;
}

}  // namespace topo::goals

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/filters.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/places/box_counts.hpp"

namespace topo::goals {
namespace {

using grid::CellState;
using places::CompassFrame;

/// Outward direction of a side, in the compass frame.
types::Vector2 outward(Side side) {
  switch (side) {
    case Side::kEast:
      return {1.0, 0.0};
    case Side::kNorth:
      return {0.0, 1.0};
    case Side::kWest:
      return {-1.0, 0.0};
    case Side::kSouth:
      return {0.0, -1.0};
    case Side::kNone:
      break;
  }
  return {0.0, 0.0};
}

/// A goal's distance from its place's centroid, in half extents.
double reach_of(const places::PlaceMap& places, const Goal& goal) {
  const places::Place& place = places.places[goal.place - 1U];
  const types::Vector2 side = place.box.max - place.box.min;
  const bool upright = goal.side == Side::kEast || goal.side == Side::kWest;
  const double across = upright ? side.x() : side.y(), along = upright ? side.y() : side.x();
  const double half = 0.5 * std::max(side.x(), side.y());
  if (along > 2.0 * across) return 0.5 * across / half;
  return (goal.p_map - place.centroid).norm() / half;
}

/// Of each goal those that can stand in for it, and it for them; itself among them. Ascending.
using StandIns = std::vector<std::vector<std::uint32_t>>;

StandIns stand_ins(const grid::DenseMap& map, std::span<Goal* const> goals, const GoalParams& params) {
  StandIns found(goals.size());
  for (std::uint32_t a = 0; a < goals.size(); ++a) {
    for (std::uint32_t b = 0; b <= a; ++b) {
      const double away_m = (goals[a]->p_map - goals[b]->p_map).norm();
      if (away_m >= params.separation_m &&
          (away_m >= params.in_sight_m ||
           !sees(map, map.cell_at(goals[a]->p_map), map.cell_at(goals[b]->p_map))))
        continue;
      found[a].push_back(b);
      if (a != b) found[b].push_back(a);
    }
  }
  return found;
}

}  // namespace

bool faces_another_place(const GoalInput& input, std::uint16_t place, Side side) {
  constexpr double kReachM = 0.5;
  const types::Vector2 middle = side_midpoint(input.places, place, side);
  const types::Vector2 out = CompassFrame(input.places.compass_rad).to_map(outward(side));
  for (double d = -kReachM; d <= kReachM; d += input.map.resolution_m) {
    const grid::CellIndex cell = input.map.cell_at(middle + d * out);
    if (!input.map.contains(cell)) continue;
    const std::uint16_t label = input.places.labels[input.map.index(cell)];
    if (label != 0 && label != place) return true;
  }
  return false;
}

void drop_near_centroid(const places::PlaceMap& places, std::span<Goal> goals_of_place,
                        const GoalParams& params) {
  struct Judged {
    double reach;
    Goal* goal;
  };
  std::vector<Judged> outermost_first, kept;
  for (Goal& goal : goals_of_place) outermost_first.push_back({reach_of(places, goal), &goal});
  std::stable_sort(outermost_first.begin(), outermost_first.end(),
                   [](const Judged& a, const Judged& b) { return a.reach > b.reach; });
  for (const Judged& at : outermost_first) {
    const bool is_near = at.reach < params.centroid_ratio && at.reach < 0.7 * outermost_first.front().reach;
    const bool has_stand_in = std::any_of(kept.begin(), kept.end(), [&](const Judged& out) {
      return out.reach > at.reach && (out.goal->p_map - at.goal->p_map).norm() < params.stand_in_m;
    });
    if (is_near && has_stand_in)
      at.goal->verdict = Verdict::kNearCentroid;
    else
      kept.push_back(at);
  }
}

void drop_duplicates(const grid::DenseMap& map, std::span<Goal> goals, const GoalParams& params) {
  std::vector<Goal*> left;
  for (Goal& goal : goals) {
    if (goal.verdict == Verdict::kAccepted) left.push_back(&goal);
  }
  std::stable_sort(left.begin(), left.end(),
                   [](const Goal* a, const Goal* b) { return a->opening_m > b->opening_m; });
  const StandIns near = stand_ins(map, left, params);
  std::vector<bool> settled(left.size(), false);
  std::vector<std::size_t> unsettled_by;  ///< how many that nobody stands in for yet, by who could
  for (const auto& of_goal : near) unsettled_by.push_back(of_goal.size());
  // A goal that was settled by another may yet stand in for more than any that is left.
  for (std::size_t todo = left.size(); todo > 0;) {
    const auto most = std::max_element(unsettled_by.begin(), unsettled_by.end());
    const auto best = static_cast<std::size_t>(most - unsettled_by.begin());
    for (const std::uint32_t b : near[best]) {
      if (settled[b]) continue;
      settled[b] = true;
      left[b]->verdict = Verdict::kDuplicate;
      --todo;
      for (const std::uint32_t by : near[b]) --unsettled_by[by];
    }
    left[best]->verdict = Verdict::kAccepted;
  }
}

bool is_visited(const Goal& goal, std::span<const std::vector<types::Vector2>> visited,
                const GoalParams& params) {
  const bool wide = goal.opening_m >= 2.0 * params.opening_min_m;
  double travelled_m = 0.0;
  for (const std::vector<types::Vector2>& way : visited) {
    bool was_near = false;
    for (std::size_t k = 0; k < way.size(); ++k) {
      const bool near = (way[k] - goal.p_map).norm() < params.visited_radius_m;
      if (near && !wide) return true;
      if (near && was_near) travelled_m += (way[k] - way[k - 1]).norm();
      was_near = near;
    }
  }
  return travelled_m >= 1.2 * params.visited_radius_m;
}

}  // namespace topo::goals

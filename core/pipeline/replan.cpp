// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/replan.hpp"

#include <algorithm>
#include <utility>

#include "core/pipeline/perceive.hpp"
#include "core/travel/travel_map.hpp"
#include "core/walls/wall_extraction.hpp"

namespace topo::pipeline {

namespace {

using exploration::Intent;
using exploration::TeamView;
using types::Stamp;
using types::Vector2;

/// On the way to a goal the map changes with every keyframe; the goal does not need an analysis as often.
/// Neither does a robot of a team that waits for a goal.
bool is_analysis_due(const Analysed& now, const Intent& intent, bool has_mates, std::uint64_t revision,
                     Stamp at, types::Duration period) {
  if (now.analysis == nullptr) return true;
  if (now.analysis->revision == revision) return false;
  const bool waits = has_mates && !intent.pursuit.goal && now.made >= now.idle_since;
  return !(intent.pursuit.goal || waits) || at - now.made >= period;
}

Analysed analysed(Analysed before, const Intent& intent, bool has_mates, const PlanningInput& in,
                  Caches& caches, const PlannerParams& params) {
  Analysed now = std::move(before);
  const travel::RouteMap& map = caches.map;
  if (now.analysis != nullptr && now.analysis->revision == map.revision()) return now;
  if (intent.pursuit.goal) now.idle_since = {};
  if (!intent.pursuit.goal && now.idle_since == Stamp{}) now.idle_since = in.now;
  const types::Duration period = exploration::row_of(params.explore.strategy).analysis_period;
  if (!is_analysis_due(now, intent, has_mates, map.revision(), in.now, period)) return now;
  now.made = in.now;
  const bool coarse = params.coarse_analysis;
  travel::CoarseMap wide =
      coarse ? travel::coarser(map.map(), map.clearance_m()) : travel::CoarseMap{map.map(), {}};
  analysis::AnalysisInput input{
      map.revision(), std::move(wide.map), coarse ? wide.clearance_m : map.clearance_m(),
      walls::wall_points(in.map->walls, params.analysis.walls.heights), driven_paths(*in.map)};
  analysis::Analysis made = analysis::analyse(std::move(input), params.analysis);
  made.coarse_m = std::move(wide.clearance_m);
  now.analysis = std::make_shared<const analysis::Analysis>(std::move(made));
  return now;
}

/// Updates map, analysis, decision and route (paper figure 6, then sections II-E and II-F).
Planned rethink(Planned before, const PlanningInput& in, const Whereabouts& place, const TeamView& team,
                bool battery_low, std::vector<Vector2> seen, Caches& caches, const PlannerParams& params) {
  auto& [intent, analysed_now, route] = before;
  const auto done = [&](PlanningStage stage) {
    if (in.done) in.done(stage);
  };
  const RouteHoldParams& hold = params.hold;
  if (route.newest.is_bent(*in.map, hold.correction_m, hold.correction_rad)) caches.ways.doubt();
  route.decided = in.now;
  route.changed_cells = in.map->changed_cells;
  route.newest = NewestKeyframe(*in.map);
  route.claims = exploration::claims_of_mates(team.roster, in.now);
  const travel::DrivenWays ways{in.map->keyframes, in.map->mates};
  caches.map.take(in.map->revision, in.map->grid, ways);
  done(PlanningStage::kMap);
  analysed_now = analysed(std::move(analysed_now), intent, team.has_mates(), in, caches, params);
  done(PlanningStage::kAnalysis);
  if (has_ended(intent.phase)) return before;
  if (std::holds_alternative<exploration::Paused>(intent.phase)) {
    route.decided = {};  // a route from before the pause is not followed after it
    return before;
  }
  caches.map.begin({in.now, place.T_map_base}, ways,
                   {intent.obstacles.echoed(), std::move(seen), intent.obstacles.stuck_on(),
                    std::vector<Vector2>(team.going_at.begin(), team.going_at.end()),
                    seen_through(in, place, caches.map.map(), ways, params)});
  done(PlanningStage::kTravel);
  const exploration::Feedback feedback{in.control->goal_id, in.control->mode == ControlMode::kArrived,
                                       in.control->mode == ControlMode::kStuck,
                                       in.control->odometry.twist.v_mps};
  const exploration::Situation situation{in.now,
                                         place.pose(),
                                         place.T_map_start.se2().translation(),
                                         in.mission,
                                         battery_low,
                                         feedback,
                                         *analysed_now.analysis,
                                         params.analysis.goals,
                                         route.points,
                                         team,
                                         in.here_first,
                                         in.doubted,
                                         in.map->keyframes};
  intent = decide(situation, {caches.map, caches.ways}, params.explore, std::move(intent));
  done(PlanningStage::kDecision);
  const bool goes = !has_ended(intent.phase) && intent.pursuit.has_target;
  route.points = goes ? caches.map.route_to(intent.pursuit.target) : std::vector<Vector2>{};
  if (std::exchange(intent.is_outdated, false)) route.decided = {};
  done(PlanningStage::kRoute);
  return before;
}

}  // namespace

Planned planned(Planned before, const PlanningInput& in, const Whereabouts& place, const TeamView& team,
                bool battery_low, Caches& caches, const PlannerParams& params) {
  auto& [intent, analysed_now, route] = before;
  const bool paused = std::holds_alternative<exploration::Paused>(intent.phase);
  if (caches.map.limit(in.area != nullptr ? *in.area : params.area)) {
    // Neither goals nor ways of before hold.
    analysed_now.analysis.reset();
    route.decided = {};
    caches.ways.doubt();
  }
  if (!std::ranges::equal(route.here_first, in.here_first)) {
    route.here_first.assign(in.here_first.begin(), in.here_first.end());
    route.decided = {};
  }
  if (std::exchange(intent.is_outdated, false)) route.decided = {};
  std::vector<Vector2> seen = seen_now(in, place, team.going_at, params);
  if (!paused && holds(route, intent, team, place, in, caches.map, battery_low, seen, params)) {
    route = trimmed(std::move(route), place.here(), params.route_map.path);
    return before;
  }
  return rethink(std::move(before), in, place, team, battery_low, std::move(seen), caches, params);
}

}  // namespace topo::pipeline

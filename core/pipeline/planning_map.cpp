// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/grid/distance.hpp"
#include "core/pipeline/planning_state.hpp"
#include "core/pipeline/prepared_map.hpp"

namespace topo::pipeline {
namespace {

constexpr types::Duration kAnalysisPeriod = std::chrono::milliseconds(3200);
constexpr types::Duration kBaselineAnalysisPeriod = std::chrono::seconds(5);
constexpr types::Duration kLiveAgeMax = std::chrono::milliseconds(300);
constexpr double kLiveRange_m = 3.0;  // what is farther will be seen again before it matters
constexpr double kBlockedRadius_m = 0.25;

double free_area_m2(const grid::DenseMap& map) {
  const auto cells = std::count(map.cells.begin(), map.cells.end(), grid::CellState::kFree);
  return static_cast<double>(cells) * map.resolution_m * map.resolution_m;
}

/// Where a robot was: corrected poses of its keyframes.
std::vector<types::Vector2> visited(const MapSnapshot& snapshot) {
  std::vector<types::Vector2> points;
  points.reserve(snapshot.keyframes.size());
  for (const KeyframePose& keyframe : snapshot.keyframes)
    points.push_back(keyframe.T_map_base.se2().translation());
  return points;
}

/// A ring of points that stands for something unseen.
void add_disc(const types::Vector2& centre, std::vector<types::Vector2>& points) {
  points.push_back(centre);
  for (const double dx : {-kBlockedRadius_m, kBlockedRadius_m}) {
    points.push_back(centre + types::Vector2(dx, 0.0));
    points.push_back(centre + types::Vector2(0.0, dx));
  }
}

constexpr double kSameEcho_m = 0.15;
constexpr int kEchoTimes = 3;  // fewer may be reflections
constexpr std::size_t kEchoesMax = 1000;
constexpr types::Duration kForgetAgain = std::chrono::seconds(60);
constexpr types::Duration kEchoFor = std::chrono::minutes(10);

}  // namespace

/// Something that no laser sees, noticed so many times.
void PlanningState::Impl::remember_unseen(const types::Vector2& p_map, int times, types::Stamp until) {
  const auto same = std::find_if(echoes.begin(), echoes.end(), [&](const Blocked& b) {
    return (b.p_map - p_map).squaredNorm() <= kSameEcho_m * kSameEcho_m;
  });
  if (same != echoes.end()) {
    same->times += times;
    same->until = until;
  } else if (echoes.size() < kEchoesMax) {
    echoes.push_back({p_map, until, times});
  }
}

void PlanningState::Impl::remember_touches(const PlanningInput& in) {
  if (in.control->touches == touches) return;
  touches = in.control->touches;
  const types::Vector2 p_map = T_map_odom.se2() * in.control->touched_odom;
  remember_unseen(p_map, kEchoTimes, in.now + kEchoFor);  // a touch is no reflection
  note(in, p_map, "touched something here");
  thought = {};
}

void PlanningState::Impl::remember_echoes(const PlanningInput& in) {
  const auto expired = [&](const Blocked& b) { return b.until <= in.now; };
  std::erase_if(echoes, expired);
  for (std::size_t i = 0; i < std::min<std::size_t>(in.control->unseen, in.control->unseen_odom.size());
       ++i) {
    remember_unseen(T_map_odom.se2() * in.control->unseen_odom[i], 1, in.now + kEchoFor);
  }
}

bool PlanningState::Impl::forget_unseen(const PlanningInput& in) {
  if ((echoes.empty() && blocked.empty()) || in.now - forgotten < kForgetAgain) return false;
  echoes.clear();
  blocked.clear();
  forgotten = in.now;
  return true;
}

void PlanningState::Impl::refresh_map(const PlanningInput& in) {
  if (in.map->revision == map_revision && !map.cells.empty()) return;
  map_revision = in.map->revision;
  map = prepare_map(*in.map, params.area, params.travel.radius_m);
  clearance.take(map);
  known_m2 = free_area_m2(map);
}

void PlanningState::Impl::refresh_analysis(const PlanningInput& in) {
  if (analysis != nullptr && analysis->revision == map_revision) return;
  // On the way to a goal the map changes with every keyframe; the goal does not need to be looked at as
  // often. The baseline decides nothing by places: they are for whoever looks on.
  const auto period = params.strategy == Strategy::kTopometric ? kAnalysisPeriod : kBaselineAnalysisPeriod;
  if (analysis != nullptr && goal && in.now - analysed < period) return;
  analysed = in.now;
  analysis = std::make_shared<const Analysis>(
      analyse(*in.map, map, clearance.clearance_m(), visited(*in.map), params.analysis, analysis_memory));
}

std::vector<types::Vector2> PlanningState::Impl::seen_now(const PlanningInput& in) const {
  if (in.front == nullptr || in.now - in.front->arrival > kLiveAgeMax) return {};
  return confirmed_points(*in.front, T_map_base.se2() * params.T_base_laser, kLiveRange_m);
}

std::vector<types::Vector2> PlanningState::Impl::unseen() const {
  std::vector<types::Vector2> points;
  for (const Blocked& b : blocked) add_disc(b.p_map, points);
  for (const Blocked& b : echoes) {
    if (b.times >= kEchoTimes) points.push_back(b.p_map);
  }
  return points;
}

void PlanningState::Impl::refresh_travel(const PlanningInput& in) {
  std::erase_if(blocked, [&](const Blocked& b) { return b.until <= in.now; });
  travel_clearance_m = clearance.clearance_m();
  lower_clearance(map, unseen(), params.travel.preferred_m, travel_clearance_m);
  keep_trail_open(map, in.map->keyframes, params.travel.radius_m, travel_clearance_m);
  lower_clearance(map, seen_now(in), params.travel.preferred_m, travel_clearance_m);
  const grid::CellIndex start = map.cell_at(T_map_base.se2().translation());
  search.begin(map, travel_clearance_m, start, params.travel, field);
}

}  // namespace topo::pipeline

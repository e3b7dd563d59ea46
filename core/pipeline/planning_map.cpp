// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/grid/distance.hpp"
#include "core/grid/free_runs.hpp"
#include "core/pipeline/planning_state.hpp"
#include "core/travel/travel_map.hpp"

namespace topo::pipeline {
namespace {

constexpr types::Duration kAnalysisPeriod = std::chrono::milliseconds(3200);
constexpr types::Duration kBaselineAnalysisPeriod = std::chrono::seconds(5);
// Two thirds of an exploration's way lead through what is known, and then little changes. What closes a goal
// is little, too.
constexpr double kChanged_m2 = 0.25;
constexpr double kAroundGoal_m = 1.5;
constexpr double kChangedAtGoal_m2 = 0.025;
constexpr types::Duration kLiveAgeMax = std::chrono::milliseconds(300);
constexpr double kLiveNoise_m = 0.05;  // of where a point is now: the scanner's and the pose's
constexpr double kLiveRange_m = 3.0;   // what is farther will be seen again before it matters
constexpr double kBlockedRadius_m = 0.25;

double free_area_m2(const grid::DenseMap& map) {
  std::size_t cells = 0;
  grid::for_each_free_run(map.cells, 0, map.cells.size(),
                          [&](std::size_t first, std::size_t end) { cells += end - first; });
  return static_cast<double>(cells) * map.resolution_m * map.resolution_m;
}

/// A ring of points that stands for something unseen.
void add_disc(const types::Vector2& centre, std::vector<types::Vector2>& points) {
  points.push_back(centre);
  for (const double dx : {-kBlockedRadius_m, kBlockedRadius_m}) {
    points.push_back(centre + types::Vector2(dx, 0.0));
    points.push_back(centre + types::Vector2(0.0, dx));
  }
}

/// Area within a square of half side `reach_m` that was unknown then and is known now.
double newly_known_m2(const grid::DenseMap& then, const grid::OccupancyGrid& now,
                      const types::Vector2& centre, double reach_m) {
  const types::Vector2 reach(reach_m, reach_m);
  const grid::CellIndex low = then.cell_at(centre - reach), high = then.cell_at(centre + reach);
  std::size_t cells = 0;
  for (std::int32_t y = low.y; y <= high.y; ++y) {
    for (std::int32_t x = low.x; x <= high.x; ++x) {
      using grid::CellState;
      if (then.state({x, y}) == CellState::kUnknown && now.state({x, y}) != CellState::kUnknown) ++cells;
    }
  }
  return static_cast<double>(cells) * then.resolution_m * then.resolution_m;
}

constexpr double kSameEcho_m = 0.15;
constexpr int kEchoTimes = 3;  // fewer may be reflections
constexpr std::size_t kEchoesMax = 1000;
constexpr types::Duration kForgetAgain = std::chrono::seconds(60);
constexpr types::Duration kEchoFor = std::chrono::minutes(10);

}  // namespace

std::vector<std::vector<types::Vector2>> driven_paths(const MapSnapshot& snapshot) {
  std::vector<std::vector<types::Vector2>> paths;
  const auto add = [&](const std::vector<types::KeyframePose>& poses) {
    std::vector<types::Vector2>& path = paths.emplace_back();
    path.reserve(poses.size());
    for (const types::KeyframePose& keyframe : poses) path.push_back(keyframe.T_map_base.se2().translation());
  };
  add(snapshot.keyframes);
  for (const std::vector<types::KeyframePose>& poses : snapshot.mates) add(poses);
  return paths;
}

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
  if (is_going_mate(p_map)) return;
  remember_unseen(p_map, kEchoTimes, in.now + kEchoFor);  // a touch is no reflection
  note(in, p_map, "touched something here");
  thought = {};
}

void PlanningState::Impl::remember_echoes(const PlanningInput& in) {
  const auto expired = [&](const Blocked& b) { return b.until <= in.now; };
  std::erase_if(echoes, expired);
  for (std::size_t i = 0; i < std::min<std::size_t>(in.control->unseen, in.control->unseen_odom.size());
       ++i) {
    const types::Vector2 p_map = T_map_odom.se2() * in.control->unseen_odom[i];
    if (!is_going_mate(p_map)) remember_unseen(p_map, 1, in.now + kEchoFor);
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
  map = travel::prepare_map(in.map->grid, {in.map->keyframes, in.map->mates}, params.area,
                            params.travel.radius_m);
  clearance.take(map);
  known_m2 = free_area_m2(map);
}

bool PlanningState::Impl::has_changed(const PlanningInput& in) const {
  const double cell_m2 = map.resolution_m * map.resolution_m;
  return static_cast<double>(in.map->changed_cells - thought_cells) * cell_m2 >= kChanged_m2 ||
         newly_known_m2(map, in.map->grid, goal->p_map, kAroundGoal_m) >= kChangedAtGoal_m2;
}

void PlanningState::Impl::refresh_analysis(const PlanningInput& in) {
  if (analysis != nullptr && analysis->revision == map_revision) return;
  // On the way to a goal the map changes with every keyframe; the goal does not need to be looked at as
  // often. The baseline decides nothing by places: they are for whoever looks on.
  const auto period =
      params.strategy == exploration::Strategy::kTopometric ? kAnalysisPeriod : kBaselineAnalysisPeriod;
  if (goal) idle_since = {};
  if (!goal && idle_since == types::Stamp{}) idle_since = in.now;
  // In a team who has no goal waits, for one or at home: once it has looked, it looks no oftener either.
  const bool waits = in.team != nullptr && !goal && analysed >= idle_since;
  if (analysis != nullptr && (goal || waits) && in.now - analysed < period) return;
  analysed = in.now;
  travel::CoarseMap wide;
  if (params.coarse_analysis) wide = travel::coarser(map, clearance.clearance_m());
  analysis::AnalysisInput input{map_revision, params.coarse_analysis ? std::move(wide.map) : map,
                                params.coarse_analysis ? wide.clearance_m : clearance.clearance_m(),
                                walls::wall_points(in.map->walls), driven_paths(*in.map)};
  analysis::Analysis made = analysis::analyse(std::move(input), params.analysis, analysis_memory);
  made.coarse_m = std::move(wide.clearance_m);
  analysis = std::make_shared<const analysis::Analysis>(std::move(made));
}

std::vector<types::Vector2> PlanningState::Impl::seen_now(const PlanningInput& in) const {
  if (in.front == nullptr || in.now - in.front->arrival > kLiveAgeMax) return {};
  std::vector<types::Vector2> points =
      travel::confirmed_points(*in.front, T_map_base.se2() * params.T_base_laser, kLiveRange_m);
  if (!going_at.empty()) std::erase_if(points, [&](const auto& p) { return is_going_mate(p); });
  return points;
}

std::vector<types::Vector2> PlanningState::Impl::stuck_on() const {
  std::vector<types::Vector2> points = too_tight;
  for (const Blocked& b : blocked) add_disc(b.p_map, points);
  return points;
}

std::vector<types::Vector2> PlanningState::Impl::echoed() const {
  std::vector<types::Vector2> points;
  for (const Blocked& b : echoes) {
    if (b.times >= kEchoTimes) points.push_back(b.p_map);
  }
  return points;
}

void PlanningState::Impl::refresh_travel(const PlanningInput& in) {
  std::erase_if(blocked, [&](const Blocked& b) { return b.until <= in.now; });
  travel_clearance_m = clearance.clearance_m();
  travel::lower_clearance(map, echoed(), params.travel.preferred_m, travel_clearance_m);
  const grid::CellIndex start = map.cell_at(T_map_base.se2().translation());
  std::vector<types::KeyframePose> last_bit;  // no keyframe tells of it yet
  if (!in.map->keyframes.empty()) last_bit = {in.map->keyframes.back(), {in.now, T_map_base}};
  const auto keep_trails_open = [&](const travel::TrailRules& rules) {
    travel::keep_trail_open(map, in.map->keyframes, start, rules, travel_clearance_m);
    travel::keep_trail_open(map, last_bit, start, rules, travel_clearance_m);
    for (const std::vector<types::KeyframePose>& way : in.map->mates)
      travel::keep_trail_open(map, way, start, rules, travel_clearance_m);
  };
  keep_trails_open({params.travel.radius_m});
  travel::lower_clearance(map, seen_now(in), params.travel.preferred_m, travel_clearance_m);
  // Noise must not shut the robot in where it came through; what really stands there stops it.
  keep_trails_open({params.travel.tight_m, params.travel.tight_m - kLiveNoise_m, kLiveRange_m});
  // What it got stuck on stands there on its own trail, too: without that it would go the same way for ever.
  travel::lower_clearance(map, stuck_on(), params.travel.preferred_m, travel_clearance_m);
  crowd_mates();
  search.begin(map, travel_clearance_m, start, params.travel, field);
  has_coarse = false;
}

void PlanningState::Impl::need_coarse() {
  if (has_coarse) return;
  has_coarse = true;
  constexpr int kDoublings = 2;
  coarse = travel::coarser(map, travel_clearance_m, kDoublings);
  coarse_search.begin(coarse.map, coarse.clearance_m, coarse.map.cell_at(T_map_base.se2().translation()),
                      params.travel, coarse_field);
  coarse_search.settle(HUGE_VAL);
}

}  // namespace topo::pipeline

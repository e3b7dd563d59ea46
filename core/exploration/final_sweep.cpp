// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/final_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace topo::exploration {
namespace {

/// Several openings may share one viewpoint: the centre of one cell.
bool is_same_stand(const types::Vector2& a, const types::Vector2& b) {
  constexpr double kRounding_m = 1e-3;
  return (a - b).norm() < kRounding_m;
}

/// The centroids of an unchanged frontier differ by rounding only.
bool is_same_frontier(const types::Vector2& a, const types::Vector2& b) { return is_same_stand(a, b); }

}  // namespace

void FinalSweep::begin(types::Stamp now) {
  *this = FinalSweep(params_);
  begun_ = now;
}

void FinalSweep::interrupt(types::Stamp now) {
  if (sweeps_since_) swept_ += now - *sweeps_since_;
  sweeps_since_.reset();
}

void FinalSweep::wait(types::Duration elapsed) {
  begun_ += elapsed;
  if (sweeps_since_) *sweeps_since_ += elapsed;
}

void FinalSweep::move(const types::MapCorrection& correction) {
  for (Open& o : open_) {
    for (types::Vector2* p : {&o.goal.p_map, &o.goal.opening, &o.sight}) *p = correction(*p);
  }
  correction.move(offered_);
  correction.move(looked_);
  answers_.clear();  // of cells of the map before
}

bool FinalSweep::is_over(types::Stamp now) const {
  if (!sweeps_since_) return false;
  const double without_s = types::to_seconds(*sweeps_since_ - begun_ - swept_);
  const double most_s = std::max(params_.time_min_s, params_.time_share * without_s);
  return types::to_seconds(swept_ + (now - *sweeps_since_)) > most_s;
}

void FinalSweep::settle(const grid::DenseMap& map, types::Stamp now) {
  if (is_over(now)) open_.clear();
  std::erase_if(open_,
                [&](const Open& o) { return map.state(map.cell_at(o.sight)) != grid::CellState::kUnknown; });
}

bool FinalSweep::arrive(std::uint64_t number) {
  const auto at = find_number(number);
  if (at == open_.end()) return false;
  for (const Open& o : open_) {
    if (is_same_stand(o.goal.p_map, at->goal.p_map)) looked_.push_back(o.goal.opening);
  }
  return leave(number);
}

bool FinalSweep::leave(std::uint64_t number) {
  const auto at = find_number(number);
  if (at == open_.end()) return false;
  const types::Vector2 stand = at->goal.p_map;
  std::erase_if(open_, [&](const Open& o) { return is_same_stand(o.goal.p_map, stand); });
  return true;
}

bool FinalSweep::has(std::uint64_t number) const { return find_number(number) != open_.end(); }

std::vector<FinalSweep::Open>::const_iterator FinalSweep::find_number(std::uint64_t number) const {
  return std::find_if(open_.begin(), open_.end(), [&](const Open& o) { return o.number == number; });
}

void FinalSweep::share(std::span<const types::Vector2> looked) {
  for (const types::Vector2& opening : looked) {
    std::erase_if(open_, [&](const Open& o) { return is_same_opening(o.goal.opening, opening); });
    if (!was_offered(opening)) offered_.push_back(opening);
  }
}

bool FinalSweep::was_offered(const types::Vector2& opening) const {
  return std::any_of(offered_.begin(), offered_.end(),
                     [&](const types::Vector2& p) { return is_same_opening(p, opening); });
}

/// A waiting robot repeats the search every second. A frontier with the same cells keeps its result.
std::optional<exploration::Viewpoint> FinalSweep::viewpoint_into(const goals::Frontier& frontier,
                                                                 const LookedAt& in, types::Stamp now) {
  const auto holds = [&](const Answer& a) {
    return is_same_frontier(a.opening, frontier.centroid) && a.cells == frontier.cells.size() &&
           (!a.look || (in.map.contains(a.look->from) && in.field.can_stay_at(in.map.index(a.look->from))));
  };
  const auto known = std::find_if(answers_.begin(), answers_.end(), holds);
  if (known != answers_.end()) return known->look;
  const auto look = exploration::find_viewpoint(in.map, frontier, in.field, in.walls, params_.look);
  answers_.push_back({frontier.centroid, frontier.cells.size(), now, look});
  return look;
}

void FinalSweep::find(const LookedAt& in, types::Stamp now, types::Duration again) {
  const auto& [map, revision, known_m2, field, walls, pocket_reach_m] = in;
  if (!open_.empty() && !sweeps_since_) sweeps_since_ = now;  // viewpoints left by an interrupted sweep
  if (!open_.empty() || is_over(now) || revision == asked_ || now - asked_at_ < again) return;
  asked_ = revision;
  asked_at_ = now;
  std::erase_if(answers_, [&](const Answer& a) { return now - a.given >= params_.still_true; });
  double promise_m2 = 0.0;
  for (const goals::Frontier& frontier : goals::find_frontiers(map, params_.opening_min_m)) {
    if (was_offered(frontier.centroid)) continue;
    // Costs a fiftieth of the search for a viewpoint, and most frontiers are rims of pockets.
    if (goals::unknown_behind_m2(map, frontier, pocket_reach_m) < params_.gain_min_m2) continue;
    const auto look = viewpoint_into(frontier, in, now);
    if (!look || look->gain_m2 < params_.gain_min_m2) continue;
    goals::Goal goal;
    goal.p_map = map.centre_of(look->from);
    goal.opening = frontier.centroid;
    goal.opening_m = frontier.width_m;
    goal.behind_m2 = look->gain_m2;
    open_.push_back({goal, ++numbered_, map.centre_of(look->sight)});
    promise_m2 += look->gain_m2;
  }
  if (promise_m2 < params_.promise_min * known_m2) open_.clear();
  for (const Open& o : open_) offered_.push_back(o.goal.opening);
  if (!open_.empty()) sweeps_since_ = now;
}

std::vector<std::uint64_t> FinalSweep::numbers() const {
  std::vector<std::uint64_t> all;
  for (const Open& o : open_) all.push_back(o.number);
  return all;
}

std::vector<goals::Goal> FinalSweep::goals() const {
  std::vector<goals::Goal> all;
  for (const Open& o : open_) all.push_back(o.goal);
  return all;
}

}  // namespace topo::exploration

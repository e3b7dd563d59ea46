// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/obstacle_memory.hpp"

#include <algorithm>
#include <tuple>

namespace topo::travel {

using types::Vector2;

void ObstacleMemory::note(const Vector2& p_map, int times, types::Stamp now) {
  const auto same = std::find_if(echoes_.begin(), echoes_.end(), [&](const Entry& e) {
    return (e.p_map - p_map).squaredNorm() <= params_.same_echo_m * params_.same_echo_m;
  });
  if (same != echoes_.end()) {
    same->times += times;
    same->until = now + params_.echo_for;
    return;
  }
  if (echoes_.size() < params_.echoes_max) {
    echoes_.push_back({p_map, now + params_.echo_for, times});
    return;
  }
  const auto weakest = std::min_element(echoes_.begin(), echoes_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.times, a.until) < std::tie(b.times, b.until);
  });
  if (weakest != echoes_.end() && weakest->times <= times) *weakest = {p_map, now + params_.echo_for, times};
}

void ObstacleMemory::block(const Vector2& p_map, types::Stamp now) {
  blocked_.push_back({p_map, now + params_.blocked_for, 1});
}

void ObstacleMemory::move(const types::MapCorrection& correction) {
  for (Entry& e : echoes_) e.p_map = correction(e.p_map);
  for (Entry& e : blocked_) e.p_map = correction(e.p_map);
  correction.move(too_tight_);
}

void ObstacleMemory::expire(types::Stamp now) {
  const auto is_over = [&](const Entry& e) { return e.until <= now; };
  std::erase_if(echoes_, is_over);
  std::erase_if(blocked_, is_over);
}

bool ObstacleMemory::forget(types::Stamp now) {
  if ((echoes_.empty() && blocked_.empty()) || now - forgotten_ < params_.forget_again) return false;
  echoes_.clear();
  blocked_.clear();
  forgotten_ = now;
  return true;
}

std::vector<Vector2> ObstacleMemory::echoed() const {
  std::vector<Vector2> points;
  for (const Entry& e : echoes_) {
    if (e.times >= params_.echo_times) points.push_back(e.p_map);
  }
  return points;
}

std::vector<Vector2> ObstacleMemory::stuck_on() const {
  std::vector<Vector2> points = too_tight_;
  for (const Entry& e : blocked_) {
    points.push_back(e.p_map);
    for (const double d_m : {-params_.blocked_radius_m, params_.blocked_radius_m}) {
      points.push_back(e.p_map + Vector2(d_m, 0.0));
      points.push_back(e.p_map + Vector2(0.0, d_m));
    }
  }
  return points;
}

}  // namespace topo::travel

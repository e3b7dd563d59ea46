// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/local_map.hpp"

#include <algorithm>
#include <utility>

namespace topo::slam {

void LocalMap::extend(const MapGraph& graph, const types::Se2& here) {
  const Point p = here.translation().cast<float>();
  const auto own = graph.own();
  const std::size_t held = own.size() - window_first_;
  // Dropping one keyframe means building the map again; therefore several are dropped at once.
  if (own.size() == 1 || (p - centre_).norm() > static_cast<float>(params_.recentre_m) ||
      held > static_cast<std::size_t>(params_.window_overfull * params_.window_travel_m / params_.travel_m)) {
    rebuild(graph, here);
  } else {
    surfels_.add(graph.keyframes()[own.back()]->content.surfels(), graph.poses()[own.back()]);
  }
}

void LocalMap::rebuild(const MapGraph& graph, const types::Se2& here) {
  const auto own = graph.own();
  const auto poses = graph.poses();
  const auto keyframes = graph.keyframes();
  centre_ = here.translation().cast<float>();
  surfels_.reset(centre_, params_.half_width_m);
  double travelled_m = 0.0;
  window_first_ = own.size() - 1;
  while (window_first_ > 0 && (travelled_m < params_.window_travel_m ||
                               own.size() - window_first_ < static_cast<std::size_t>(params_.window_min))) {
    travelled_m += distance_m(poses[own[window_first_]], poses[own[window_first_ - 1]]);
    --window_first_;
  }
  for (std::size_t k = window_first_; k < own.size(); ++k)
    surfels_.add(keyframes[own[k]]->content.surfels(), poses[own[k]]);
  if (window_first_ > resumed_at_) neighbours_.clear();
  for (const std::size_t i : neighbours_) {
    if (i < own[window_first_]) surfels_.add(keyframes[i]->content.surfels(), poses[i]);
  }
}

void LocalMap::resume(const MapGraph& graph, const types::Se2& here, std::vector<std::size_t> neighbours) {
  neighbours_ = std::move(neighbours);
  resumed_at_ = graph.own().size() - 1;
  rebuild(graph, here);
}

FreeGround LocalMap::ground(const MapGraph& graph) const {
  std::vector<KeyframePtr> keyframes;
  std::vector<types::Se2> poses;
  for (const std::size_t node : graph.own().subspan(window_first_)) {
    keyframes.push_back(graph.keyframes()[node]);
    poses.push_back(graph.poses()[node]);
  }
  return seen_through(keyframes, poses, surfels_, free_ground_);
}

bool LocalMap::has_enough_alike(const MapGraph& graph, const types::Se2& here) const {
  const auto window = graph.own().subspan(window_first_);
  const auto alike = std::count_if(window.begin(), window.end(), [&](std::size_t node) {
    return !types::is_apart(graph.poses()[node], here, params_.alike_m, params_.alike_rad);
  });
  return alike >= params_.alike_max;
}

}  // namespace topo::slam

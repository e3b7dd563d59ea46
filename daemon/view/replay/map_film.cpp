// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/map_film.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "daemon/app/display_json.hpp"

namespace topo::daemon {

void MapFilm::load(MapHistory history) {
  history_ = std::move(history);
  builder_.reset();
}

bool MapFilm::show(std::size_t keyframes) {
  const std::size_t count = std::min(keyframes, history_.keyframes().size());
  if (builder_ != nullptr && count == poses_.size()) return false;  // the poses of then follow from it
  std::vector<types::Se2> poses = history_.poses(count);
  if (builder_ == nullptr || poses.size() < poses_.size())
    builder_ = std::make_unique<slam::MapBuilder>(params_);
  poses_ = std::move(poses);
  builder_->update(std::span(history_.keyframes()).first(poses_.size()), poses_);
  book_.update(builder_->grid());
  return true;
}

Json MapFilm::tiles(std::uint64_t since) const {
  return tiles_json(book_.since(since, kDisplayBytes), params_.resolution_m);
}

Json MapFilm::trails() const {
  std::map<std::uint16_t, std::vector<types::Vector2>> ways;
  const auto& keyframes = history_.keyframes();
  for (std::size_t i = 0; i < poses_.size(); ++i)
    ways[keyframes[i]->id.robot].push_back(poses_[i].translation());
  Json own = Json::array(), mates = Json::array();
  for (const auto& [robot, way] : ways) {
    Json trail = trail_json(way);
    if (is_own(robot)) {
      own = std::move(trail);
    } else {
      mates.push_back(std::move(trail));
    }
  }
  return {{"own", std::move(own)}, {"mates", std::move(mates)}};
}

std::vector<LastPlace> MapFilm::last_places() const {
  std::map<std::uint16_t, LastPlace> newest;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    const std::uint16_t robot = history_.keyframes()[i]->id.robot;
    if (!is_own(robot)) newest[robot] = {robot, poses_[i], i};
  }
  std::vector<LastPlace> places;
  places.reserve(newest.size());
  for (const auto& [robot, place] : newest) places.push_back(place);
  return places;
}

/// A map begins with the robot that made it.
bool MapFilm::is_own(std::uint16_t robot) const { return robot == history_.keyframes().front()->id.robot; }

}  // namespace topo::daemon

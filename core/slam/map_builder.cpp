// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/map_builder.hpp"

#include <cmath>
#include <utility>

#include "core/grid/occupancy_grid.hpp"

namespace topo::slam {

MapBuilder::MapBuilder(const GridParams& params)
    : params_(params),
      shown_{grid::OccupancyGrid(tile_arena_, params.resolution_m),
             walls::WallStore(column_arena_, params.resolution_m),
             {}} {}

void MapBuilder::adopt() {
  tile_arena_.adopt();
  column_arena_.adopt();
}

void MapBuilder::extend(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses) {
  for (std::size_t i = shown_.drawn.size(); i < keyframes.size(); ++i) {
    const Keyframe& keyframe = *keyframes[i];
    if (!next_) {
      draw(shown_, i, keyframe, poses[i]);
      continue;
    }
    // This version ends when the next one is shown: nothing will be removed from it.
    rasteriser_.draw(shown_.grid, poses[i], keyframe.sensor, keyframe.content.hits());
    walls::draw_columns(shown_.walls, keyframe.content.columns(), poses[i]);
    shown_.drawn.push_back(poses[i]);
  }
}

bool MapBuilder::prepare(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                         std::size_t beams_max) {
  if (!next_) {
    next_ = shown_;
    prepared_ = 0;
  }
  for (std::size_t beams = 0; prepared_ < keyframes.size(); ++prepared_) {
    if (is_drawn_well(*next_, prepared_, poses[prepared_])) continue;
    if (beams >= beams_max) return false;
    const Keyframe& keyframe = *keyframes[prepared_];
    draw(*next_, prepared_, keyframe, poses[prepared_]);
    beams += keyframe.content.beams();
  }
  return true;
}

void MapBuilder::show() {
  if (!next_) return;
  shown_ = *std::exchange(next_, std::nullopt);
  settled_ = 0;
}

bool MapBuilder::settle(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                        std::size_t beams_max) {
  if (next_) return false;
  for (std::size_t beams = 0; settled_ < shown_.drawn.size(); ++settled_) {
    if (shown_.drawn[settled_] == poses[settled_]) continue;
    if (beams >= beams_max) return false;
    const Keyframe& keyframe = *keyframes[settled_];
    draw(shown_, settled_, keyframe, poses[settled_]);
    beams += keyframe.content.beams();
  }
  return true;
}

void MapBuilder::update(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses) {
  show();
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    if (i >= shown_.drawn.size() || shown_.drawn[i] != poses[i]) draw(shown_, i, *keyframes[i], poses[i]);
  }
}

bool MapBuilder::is_drawn_well(const Version& version, std::size_t i, const types::Se2& pose) const {
  if (i >= version.drawn.size()) return false;
  const types::Se2& drawn = version.drawn[i];
  return distance_m(pose, drawn) < params_.redo_m &&
         std::abs(types::wrap_angle(pose.theta_rad - drawn.theta_rad)) < params_.redo_rad;
}

/// Draws into a version from which later ones are derived. The keyframe is already in it, or follows the last
/// one.
void MapBuilder::draw(Version& version, std::size_t i, const Keyframe& keyframe, const types::Se2& pose) {
  if (i < version.drawn.size()) {
    rasteriser_.move(version.grid, version.drawn[i], pose, keyframe.sensor, keyframe.content.hits());
    ledger_.move(version.walls, keyframe.content.columns(), version.drawn[i], pose);
    version.drawn[i] = pose;
  } else {
    rasteriser_.draw(version.grid, pose, keyframe.sensor, keyframe.content.hits());
    ledger_.draw(version.walls, keyframe.content.columns(), pose);
    version.drawn.push_back(pose);
  }
}

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/map_builder.hpp"

#include <cmath>

namespace topo::slam {

MapBuilder::MapBuilder(const GridParams& params)
    : params_(params), grid_(tile_arena_, params.resolution_m), walls_(column_arena_, params.resolution_m) {}

void MapBuilder::adopt() {
  tile_arena_.adopt();
  column_arena_.adopt();
}

void MapBuilder::update(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses) {
  bool moved = false;
  const std::size_t known = drawn_.size();
  for (std::size_t i = 0; i < known; ++i) {
    const types::Se2 off = drawn_[i].inverse() * poses[i];
    if (std::hypot(off.x_m, off.y_m) < params_.redo_m && std::abs(off.theta_rad) < params_.redo_rad) continue;
    const Keyframe& keyframe = *keyframes[i];
    rasteriser_.move(grid_, drawn_[i], poses[i], keyframe.sensor, keyframe.hits);
    drawn_[i] = poses[i];
    moved = true;
  }
  for (std::size_t i = known; i < keyframes.size(); ++i) {
    rasteriser_.draw(grid_, poses[i], keyframes[i]->sensor, keyframes[i]->hits);
    drawn_.push_back(poses[i]);
  }
  if (moved) walls_.clear();
  for (std::size_t i = moved ? 0 : known; i < keyframes.size(); ++i) draw_columns(*keyframes[i], drawn_[i]);
}

void MapBuilder::draw_columns(const Keyframe& keyframe, const types::Se2& pose) {
  for (const walls::ColumnPoint& column : keyframe.columns) {
    walls_.add(pose * types::Vector2(static_cast<double>(column.x_m), static_cast<double>(column.y_m)),
               column.slabs);
  }
}

}  // namespace topo::slam

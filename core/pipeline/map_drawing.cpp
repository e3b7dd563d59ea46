// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/map_drawing.hpp"

#include <limits>
#include <utility>

#include "core/grid/occupancy_grid.hpp"

namespace topo::pipeline {
namespace {

std::vector<types::KeyframePose> stations(const slam::Mapper& mapper, std::span<const std::size_t> way) {
  std::vector<types::KeyframePose> out;
  out.reserve(way.size());
  for (const std::size_t i : way)
    out.push_back(
        {mapper.keyframes()[i]->stamp, types::Transform2<types::Map, types::Base>(mapper.poses()[i])});
  return out;
}

}  // namespace

void MapDrawing::correct(const slam::Mapper& mapper, slam::GraphSolution solution) {
  std::vector<types::Se2> poses = mapper.corrected(solution);
  correction_ = {std::move(solution), std::move(poses)};
}

void MapDrawing::redraw(const slam::Mapper& mapper, types::Stamp placed) {
  if (correction_) {
    const auto keyframes = mapper.keyframes().first(correction_->poses.size());
    correction_->drawn = builder_.prepare(keyframes, correction_->poses, params_.redrawn_a_scan);
    return;
  }
  if (is_settled_ || placed - corrected_ < params_.settle_after) return;
  is_settled_ = builder_.settle(mapper.keyframes(), mapper.poses(), params_.settled_a_scan);
  has_settled_ = is_settled_;
}

bool MapDrawing::draw(slam::Mapper& mapper, types::Stamp placed) {
  has_settled_ = false;
  if (correction_) correction_->poses = mapper.corrected(correction_->solution);
  if (!correction_ || !correction_->drawn) {
    builder_.extend(mapper.keyframes(), mapper.poses());
    return false;
  }
  (void)builder_.prepare(mapper.keyframes(), correction_->poses, std::numeric_limits<std::size_t>::max());
  builder_.show();
  mapper.adopt(std::move(correction_->poses));
  correction_.reset();
  corrected_ = placed;
  is_settled_ = false;
  return true;
}

std::unique_ptr<MapSnapshot> MapDrawing::make_snapshot(const slam::Mapper& mapper, std::uint64_t revision,
                                                       types::Stamp placed) {
  // Compared with the previous snapshot: the tiles that differ have been copied for its readers anyway.
  if (published_) changed_cells_ += grid::differing_cells(*published_, builder_.grid());
  published_ = builder_.grid();
  auto snapshot = std::make_unique<MapSnapshot>(MapSnapshot{
      revision, changed_cells_, placed, types::Transform2<types::Map, types::Odom>(mapper.T_map_odom()),
      types::Transform2<types::Map, types::Base>(mapper.T_map_base()), builder_.grid(), builder_.walls(),
      stations(mapper, mapper.own_way())});
  for (const auto& [origin, way] : mapper.mates_ways()) snapshot->mates.push_back(stations(mapper, way));
  return snapshot;
}

}  // namespace topo::pipeline

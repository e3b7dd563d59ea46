// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/slam/free_ground.hpp"
#include "core/slam/map_graph.hpp"
#include "core/slam/params.hpp"
#include "core/slam/surfel_map.hpp"

namespace topo::slam {

/// The surfels that tracking matches scans against: those of the newest keyframes of the own path (the
/// window), and after resume() those of older keyframes around the robot, until the window has left that
/// place. Team-mates' keyframes stay out: the frame of what the robot saw itself is certain.
class LocalMap {
 public:
  /// `reach_m`: RefineParams.
  LocalMap(const KeyframeParams& params, const FreeGroundParams& free_ground, double reach_m)
      : params_(params), free_ground_(free_ground), surfels_(reach_m) {}

  /// Adds the newest keyframe of the own path; `here`: the robot.
  void extend(const MapGraph& graph, const types::Se2& here);
  /// Builds the map again, after poses have changed.
  void rebuild(const MapGraph& graph, const types::Se2& here);
  /// The window begins with the newest keyframe of the own path; `neighbours`: older nodes around it.
  void resume(const MapGraph& graph, const types::Se2& here, std::vector<std::size_t> neighbours);

  [[nodiscard]] const SurfelMap& surfels() const { return surfels_; }
  /// Ground that the window's keyframes saw through.
  [[nodiscard]] FreeGround ground(const MapGraph& graph) const;
  /// True when the window has enough keyframes made here, in this heading (KeyframeParams::alike_max).
  [[nodiscard]] bool has_enough_alike(const MapGraph& graph, const types::Se2& here) const;

 private:
  KeyframeParams params_;
  FreeGroundParams free_ground_;
  SurfelMap surfels_;
  std::size_t window_first_ = 0;  ///< place on the own path
  Point centre_ = Point::Zero();
  std::size_t resumed_at_ = 0;           ///< place on the own path of the first keyframe since resume()
  std::vector<std::size_t> neighbours_;  ///< older nodes around it
};

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "core/pipeline/map_snapshot.hpp"
#include "core/pipeline/mapping_params.hpp"
#include "core/slam/graph_solution.hpp"
#include "core/slam/map_builder.hpp"
#include "core/slam/mapper.hpp"

namespace topo::pipeline {

/// The published map, drawn from the mapper's keyframes. A correction is drawn beside it, one part with every
/// scan; poses and map change together, at a keyframe boundary.
class MapDrawing {
 public:
  MapDrawing(const slam::MapperParams& mapper, const DrawingParams& params)
      : params_(params), builder_(mapper.grid) {}

  /// Draws all keyframes at their present poses, at once.
  void update(const slam::Mapper& mapper) { builder_.update(mapper.keyframes(), mapper.poses()); }
  /// Takes corrected poses, to be drawn part by part.
  void correct(const slam::Mapper& mapper, slam::GraphSolution solution);
  void drop_correction() { correction_.reset(); }

  /// Draws a part of the correction, or of what a correction left displaced. `placed`: stamp of the newest
  /// scan.
  void redraw(const slam::Mapper& mapper, types::Stamp placed);
  /// Call at a keyframe boundary: draws what is new since the last one, and shows the corrected poses when
  /// all of them are drawn. True when the mapper adopted these.
  bool draw(slam::Mapper& mapper, types::Stamp placed);
  /// True when there is something to show: a completely drawn correction, or the end of its settling since
  /// the last boundary.
  [[nodiscard]] bool has_news() const { return (correction_ && correction_->drawn) || has_settled_; }

  /// The present map.
  [[nodiscard]] std::unique_ptr<MapSnapshot> make_snapshot(const slam::Mapper& mapper, std::uint64_t revision,
                                                           types::Stamp placed);
  /// Makes the calling thread the owner of the map's nodes.
  void adopt() { builder_.adopt(); }

 private:
  struct Correction {
    slam::GraphSolution solution;
    std::vector<types::Se2> poses;  ///< of the keyframes present at the last boundary
    bool drawn = false;             ///< all of them
  };

  DrawingParams params_;
  slam::MapBuilder builder_;
  std::optional<Correction> correction_;
  bool is_settled_ = true;                        // in the shown map every keyframe is in its place, to the
                                                  // cell
  bool has_settled_ = false;                      // since the last boundary
  types::Stamp corrected_{};                      // stamp of the newest scan when a correction was last shown
  std::optional<grid::OccupancyGrid> published_;  // of the newest snapshot
  std::uint64_t changed_cells_ = 0;               // from the first snapshot to the newest
};

}  // namespace topo::pipeline

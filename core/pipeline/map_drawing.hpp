// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/grid/occupancy_grid.hpp"
#include "core/pipeline/map_snapshot.hpp"
#include "core/slam/graph_solution.hpp"
#include "core/slam/map_builder.hpp"
#include "core/slam/mapper.hpp"

namespace topo::pipeline {

/// The map that is shown, drawn of the mapper's keyframes. A correction is drawn beside it, a piece with
/// every scan; poses and map change together, at a keyframe boundary.
class MapDrawing {
 public:
  explicit MapDrawing(const slam::MapperParams& params) : builder_(params.grid) {}

  /// All keyframes where they are now, at once.
  void update(const slam::Mapper& mapper) { builder_.update(mapper.keyframes(), mapper.poses()); }
  /// Corrected poses, to be drawn piece by piece.
  void correct(const slam::Mapper& mapper, slam::GraphSolution solution);
  void drop_correction() { correction_.reset(); }

  /// A piece of the correction, or what a correction left a little off. `placed`: stamp of the newest scan.
  void redraw(const slam::Mapper& mapper, types::Stamp placed);
  /// At a keyframe boundary: what came since the last one, and the corrected poses when all of them are
  /// drawn. True when the mapper took them over.
  bool draw(slam::Mapper& mapper, types::Stamp placed);
  /// True when there is something to show: a correction that is drawn, or the last of it since the last
  /// boundary.
  [[nodiscard]] bool has_news() const { return (correction_ && correction_->drawn) || has_settled_; }

  /// The map as it stands.
  [[nodiscard]] std::unique_ptr<MapSnapshot> make_snapshot(const slam::Mapper& mapper, std::uint64_t revision,
                                                           types::Stamp placed);
  /// Makes the calling thread the owner of the map's nodes.
  void adopt() { builder_.adopt(); }

 private:
  struct Correction {
    slam::GraphSolution solution;
    std::vector<types::Se2> poses;  ///< of the keyframes that were there at the last boundary
    bool drawn = false;             ///< all of them
  };

  slam::MapBuilder builder_;
  std::optional<Correction> correction_;
  bool is_settled_ = true;                        // the shown map has every keyframe where it is, to the cell
  bool has_settled_ = false;                      // since the last boundary
  types::Stamp corrected_{};                      // stamp of the newest scan when a correction was shown last
  std::optional<grid::OccupancyGrid> published_;  // of the newest snapshot
  std::uint64_t changed_cells_ = 0;               // from the first snapshot to that one
};

}  // namespace topo::pipeline

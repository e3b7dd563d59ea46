// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/pipeline/map_snapshot.hpp"
#include "core/slam/loop_closure.hpp"
#include "core/slam/mapper.hpp"
#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"

namespace topo::pipeline {

/// What came since the last step, oldest first. Scans must not be older than ones given before.
struct MappingInput {
  std::span<const types::Odometry> odometry;
  const types::Scan* front = nullptr;    ///< at most one a step
  const types::Scan* coronal = nullptr;  ///< at most one a step
};

struct MappingOutput {
  std::optional<slam::MatchReport> match;        ///< of the front scan, when it was matched in this step
  bool keyframe_added = false;                   ///< publish a snapshot
  std::optional<slam::LoopQuery> loop_query;     ///< for the loop closure thread
  std::optional<slam::LoopVerdict> loop_verdict; ///< of the answer that was applied in this step
};

/// The mapping thread's whole state: keyframes, local map, pose graph, grid, wall store.
class MappingState {
 public:
  explicit MappingState(const slam::MapperParams& params);
  ~MappingState();
  MappingState(const MappingState&) = delete;
  MappingState& operator=(const MappingState&) = delete;

  /// Hands over what the loop closure thread found; it is applied at the next keyframe boundary.
  void offer(slam::LoopAnswer answer);

  /// The map as it stands. To be destroyed by the thread that made it.
  [[nodiscard]] std::unique_ptr<MapSnapshot> make_snapshot();

  [[nodiscard]] slam::Mapper& mapper();

 private:
  friend MappingOutput mapping_step(MappingState&, const MappingInput&);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One step of the mapper (DESIGN section 2): pairs scans with the odometry around them, deskews, matches, adds
/// keyframes, applies closures. A scan waits inside until odometry at or after its end is there, or until
/// `slam::MapperParams::odometry_wait_s` of scan time has gone by.
MappingOutput mapping_step(MappingState& state, const MappingInput& input);

}  // namespace topo::pipeline

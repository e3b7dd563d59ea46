// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/pipeline/map_snapshot.hpp"
#include "core/pipeline/mapping_losses.hpp"
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

/// What one step did. Scans wait for odometry, so that a step may place none or several.
struct MappingOutput {
  std::vector<slam::MatchReport> matches;               ///< of the front scans placed in this step
  std::vector<slam::LoopQuery> loop_queries;            ///< for the loop closure thread
  std::optional<slam::AlignmentQuery> alignment_query;  ///< for the same thread
  std::optional<slam::GraphQuery> graph_query;          ///< the same; no other comes until it is answered
  std::vector<slam::LoopVerdict> loop_verdicts;         ///< of answers that were applied in this step
  slam::JoinVerdict joined;                             ///< what became of what team-mates sent
  bool keyframe_added = false;                          ///< the map changed: publish a snapshot
  bool corrected = false;                               ///< keyframes are elsewhere now, and so is the robot
};

/// The mapping thread's whole state: keyframes, local map, pose graph, grid, wall store. Used by one thread.
class MappingState {
 public:
  /// `start`: where the map has the robot at its first scan.
  explicit MappingState(const slam::MapperParams& params, const slam::Origin& origin = {},
                        const types::Se2& start = {});
  /// Goes on with a session that was checked, from where a scan was found in its map. Draws the whole map.
  MappingState(const slam::MapperParams& params, const slam::Session& session, const slam::Arrival& arrival,
               const slam::Origin& origin = {});
  ~MappingState();
  MappingState(const MappingState&) = delete;
  MappingState& operator=(const MappingState&) = delete;

  /// Makes the calling thread the owner of the map's nodes: once, when the mapping thread takes over a state
  /// that another thread built.
  void adopt();

  /// Counts on from here: this map is a later generation than whatever was published before.
  void follow(std::uint64_t revision);

  /// Hands over what the loop closure thread found; it is applied at the next keyframe boundary.
  void offer(slam::LoopAnswer answer);
  /// The same of a team-mate's map; one that is not believed changes nothing.
  void offer(const slam::Alignment& alignment);
  /// Hands over the answer to a graph query. The map is redrawn with the poses beside the one that is shown,
  /// a piece with every scan; poses and map change together, at the first keyframe boundary after that, or
  /// after a second without one.
  void offer(slam::GraphSolution solution);

  /// Hands over what team-mates saw and found (Mapper::join), and what the robot knows of its own about where
  /// they are (Mapper::relate); taken in at the next keyframe boundary, or after a second without one.
  void join(std::span<const slam::KeyframePtr> keyframes, std::span<const slam::FoundRelation> relations);
  void relate(const slam::RelationKey& key, const slam::Relation& relation);

  /// Places the scans that still wait for odometry, applies the answers that still wait for a keyframe, and
  /// solves the pose graph once more, all at once: the end of a log.
  MappingOutput finish();

  /// The map as it stands. To be destroyed by the thread that made it, before this state.
  [[nodiscard]] std::unique_ptr<MapSnapshot> make_snapshot();

  [[nodiscard]] const slam::Mapper& mapper() const;
  [[nodiscard]] std::uint64_t revision() const;
  /// The front scan placed last, deskewed; at its stamp the robot was at mapper().T_odom_base() in odom.
  /// Empty before the first.
  [[nodiscard]] const slam::Cloud& cloud() const;
  [[nodiscard]] const MappingLosses& losses() const;

 private:
  friend MappingOutput mapping_step(MappingState&, const MappingInput&);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One step of the mapper (DESIGN section 2): pairs scans with the odometry around them, deskews, matches,
/// adds keyframes, applies closures. A scan waits inside until odometry at or after its end is there, or
/// until `slam::MapperParams::odometry_wait_s` of scan time has gone by.
MappingOutput mapping_step(MappingState& state, const MappingInput& input);

}  // namespace topo::pipeline

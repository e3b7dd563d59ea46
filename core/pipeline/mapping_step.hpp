// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/pipeline/map_snapshot.hpp"
#include "core/pipeline/mapping_losses.hpp"
#include "core/pipeline/mapping_params.hpp"
#include "core/slam/arrival_trial.hpp"
#include "core/slam/loop_closure.hpp"
#include "core/slam/mapper.hpp"
#include "core/types/base_state.hpp"
#include "core/types/scan.hpp"

namespace topo::pipeline {

/// Data received since the last step, oldest first. Scans must not be older than earlier ones.
struct MappingInput {
  std::span<const types::Odometry> odometry;
  const types::Scan* front = nullptr;    ///< at most one per step
  const types::Scan* coronal = nullptr;  ///< at most one per step
  /// The loop closure thread has searches left to do: that of an idle robot's past waits, and is not lost.
  bool is_searching = false;
};

/// Result of one step. Scans wait for odometry, so that a step may place none or several.
struct MappingOutput {
  std::vector<slam::MatchReport> matches;               ///< of the front scans placed in this step
  std::vector<slam::LoopQuery> loop_queries;            ///< for the loop closure thread
  std::optional<slam::AlignmentQuery> alignment_query;  ///< for the same thread
  std::optional<slam::GraphQuery> graph_query;          ///< for the same thread; no other query comes until
                                                        ///< it is answered
  std::vector<slam::LoopVerdict> loop_verdicts;         ///< of answers applied in this step
  slam::JoinVerdict joined;                             ///< result of joining the team-mates' data
  bool keyframe_added = false;                          ///< the map changed: publish a snapshot
  bool corrected = false;                               ///< the poses of keyframes have changed, and so has
                                                        ///< the robot's
};

/// The complete state of the mapping thread: keyframes, local map, pose graph, grid, wall store. Used by one
/// thread.
class MappingState {
 public:
  /// `start`: the robot's pose in the map at its first scan.
  explicit MappingState(const slam::MapperParams& params, const slam::Origin& origin = {},
                        const types::Se2& start = {}, const MappingStepParams& step = {});
  /// Resumes a validated session at the pose where a scan was found in its map. Draws the whole map.
  MappingState(const slam::MapperParams& params, const slam::Session& session, const slam::Arrival& arrival,
               const slam::Origin& origin = {}, const MappingStepParams& step = {});
  ~MappingState();
  MappingState(const MappingState&) = delete;
  MappingState& operator=(const MappingState&) = delete;

  /// Makes the calling thread the owner of the map's nodes: once, when the mapping thread takes over a state
  /// built by another thread.
  void adopt();

  /// Continues the count of generations after `revision`, which was already published.
  void follow(std::uint64_t revision);

  /// Takes a result of the loop closure thread, which is applied at the next keyframe boundary.
  void offer(slam::LoopAnswer answer);
  /// The same for the alignment with a team-mate's map; one without a result changes nothing.
  void offer(const slam::Alignment& alignment);
  /// Takes the answer to a graph query. The map is redrawn with the new poses beside the published one, a
  /// part with every scan; poses and map change together, at the first keyframe boundary after that, or after
  /// MappingStepParams::news_wait without one.
  void offer(slam::GraphSolution solution);

  /// Take observations and relations of team-mates (Mapper::join), and the robot's own relations to them
  /// (Mapper::relate); both are used at the next keyframe boundary, or after
  /// news_wait without one.
  void join(std::span<const slam::KeyframePtr> keyframes, std::span<const slam::FoundRelation> relations);
  void relate(const slam::RelationKey& key, const slam::Relation& relation);

  /// A search of the own past that is left to do at the end of a log, after finish(): its answer is offered,
  /// and finish() called again. Empty when there is none left.
  [[nodiscard]] std::optional<slam::AlignmentQuery> take_idle_query();

  /// Places the scans that wait for odometry, applies the answers that wait for a keyframe, and solves the
  /// pose graph once more, at once: for the end of a log.
  MappingOutput finish();

  /// The present map. The thread that made it must destroy it before this state.
  [[nodiscard]] std::unique_ptr<MapSnapshot> make_snapshot();

  [[nodiscard]] const slam::Mapper& mapper() const;
  [[nodiscard]] std::uint64_t revision() const;
  /// The front scan placed last, deskewed; at its stamp the robot's pose in odom was mapper().T_odom_base().
  /// Empty before the first.
  [[nodiscard]] const slam::Cloud& cloud() const;
  [[nodiscard]] const MappingLosses& losses() const;
  /// Whether the first metres in a resumed session match its map; kNone for a map of its own. When kDropped
  /// the robot's place is unknown, and all that was added since is at a wrong place: this state is to be
  /// replaced.
  [[nodiscard]] slam::TrialCount trial() const;

 private:
  friend MappingOutput mapping_step(MappingState&, const MappingInput&);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One step of the mapper (DESIGN section 2): pairs scans with the odometry around them, deskews, matches,
/// adds keyframes, applies closures. A scan waits until odometry at or after its end is available, or until
/// `slam::MapperParams::odometry_wait_s` of scan time has passed.
MappingOutput mapping_step(MappingState& state, const MappingInput& input);

}  // namespace topo::pipeline

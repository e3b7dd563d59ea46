// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/pipeline/mapping_step.hpp"
#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/mapping_team.hpp"
#include "daemon/threads/vitals.hpp"
#include "daemon/threads/worker.hpp"

namespace topo::daemon {

/// The mapping thread: sole writer of keyframes, grid, wall store and snapshots. It owns the nodes of all
/// maps in use: it builds them, or adopts those of a session that another thread built, and frees them.
class MappingWorker final : public Worker {
 public:
  /// When more scans wait, all but the newest are skipped.
  static constexpr std::size_t kBacklog = 12;

  /// `origin`: origin of the keyframes of the first map, which begins at `start`. `with_team`: mates are
  /// heard.
  MappingWorker(HandOvers& hand_overs, const slam::MapperParams& params, const slam::Origin& origin,
                Vitals& vitals, const types::Se2& start = {}, bool with_team = false);

  /// The thread's body: runs until hand_overs.ending.readers_gone, because it destroys the map cell; it stops
  /// mapping at hand_overs.ending.stopping.
  void run() noexcept override;

 private:
  /// Counts of queries of one kind to the loop closure thread.
  struct Questions {
    std::uint64_t asked = 0, answered = 0;
    std::uint64_t stale_until = 0;  ///< answers up to this one concern a former map
  };
  template <class Query, std::size_t N>
  bool ask(sync::Ring<Query, N>& ring, Questions& questions, Query& query);
  template <class Answer, std::size_t N>
  static void take_answers(sync::Ring<Answer, N>& ring, Questions& questions, pipeline::MappingState& state);

  bool serve(pipeline::MappingState& state);
  void take_over(std::unique_ptr<pipeline::MappingState>& state);
  void take_odometry();
  bool step(pipeline::MappingState& state);
  [[nodiscard]] types::Se2 place_now(const pipeline::MappingState& state);
  void skip_backlog(sync::Ring<types::Scan, kScanRing>& ring);
  void use(pipeline::MappingState& state, pipeline::MappingOutput& output);
  void note_trial(const pipeline::MappingState& state);
  void publish(pipeline::MappingState& state);
  void hand_over_pose(const pipeline::MappingState& state, types::Stamp stamp, bool matched);

  HandOvers& hand_overs_;
  slam::MapperParams params_;
  slam::Origin maker_;
  types::Se2 start_;
  Vitals& vitals_;
  std::vector<types::Odometry> odometry_;
  types::Se2 T_odom_base_;  ///< the newest; kept with a team only
  MappingReport report_;
  plausibility::MatchedMotion matched_;                          ///< since the start
  std::vector<std::unique_ptr<pipeline::MappingState>> former_;  ///< readers may still use their maps
  Questions loops_, graphs_, alignments_;
  std::optional<MappingTeam> team_;  ///< nothing without a team
};

}  // namespace topo::daemon

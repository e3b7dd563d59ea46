// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pipeline/planning_step.hpp"
#include "daemon/threads/hand_overs.hpp"
#include "daemon/threads/vitals.hpp"
#include "daemon/threads/worker.hpp"

namespace topo::daemon {

/// The planning thread: sole writer of the plan and of planning's reports. Decides at whole periods, and at
/// once when the mission changes.
class PlanningWorker final : public Worker {
 public:
  static constexpr std::uint16_t kNoTeam = 0;

  /// `robot`: its number in a team, or kNoTeam.
  PlanningWorker(HandOvers& hand_overs, const pipeline::PlannerParams& params, types::Duration period,
                 std::uint16_t robot, Vitals& vitals)
      : hand_overs_(hand_overs), params_(params), period_(period), robot_(robot), vitals_(vitals) {}

  /// The thread's body: until hand_overs.ending.stopping. Ends the reports' cell, so that its readers must be
  /// gone by then.
  void run() noexcept override;

 private:
  void decide(pipeline::PlanningState& state, MapSnapshots::Reader& maps);
  void note_budget(types::Stamp begin, types::Stamp end);

  HandOvers& hand_overs_;
  pipeline::PlannerParams params_;
  types::Duration period_;
  std::uint16_t robot_;
  Vitals& vitals_;
  pipeline::Mission mission_;
  std::int64_t slow_ = 0;  ///< decisions that took longer than the period
  Rarely told_slow_;
};

}  // namespace topo::daemon

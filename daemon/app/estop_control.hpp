// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/pipeline/control_step.hpp"
#include "core/sync/estop_line.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/estop/latch_keeper.hpp"

namespace topo::daemon {

/// The e-stop on main: pressed by operators, kept in a file beyond the daemon's end, released by the
/// operator's clear and by nothing else. The base's thread is told first; the file follows on a thread of its
/// own, and what became of it is logged, announced and reported. Main only.
class EStopControl {
 public:
  using Announce = std::function<void(const Json& event)>;
  using Done = std::function<void(types::Status)>;

  /// `folder`: control.state_folder; empty: nothing is kept. `base`: the newest report of the base's thread.
  EStopControl(sync::EStopLine<>& line, std::function<const pipeline::ControlReport&()> base,
               const std::string& folder, Announce announce);

  /// Latches when the file says so, and starts the thread. To be called before the base's thread is started.
  types::Status start();

  void press();
  /// The base is released after the file is gone from the disk, then `done` is called; on failure, or when
  /// the e-stop is pressed meanwhile, everything stays latched and `done` gets the reason.
  void clear(Done done);
  /// Every tick: the stop button on the robot latches, too.
  void tick();
  /// When fd() is readable.
  void collect();
  [[nodiscard]] int fd() const { return keeper_.fd(); }

  /// According to the operator's request, or to a report of the base later than the last clear.
  [[nodiscard]] bool latched() const;
  /// The operator's alone. The base's report follows a clear with delay.
  [[nodiscard]] bool pressed() const { return line_.pressed(); }
  /// Why nothing moves, and the cure; empty when not latched.
  [[nodiscard]] std::string obstacle() const;
  /// What is wrong with the keeping; empty: nothing.
  [[nodiscard]] std::string trouble() const;
  /// {"kept": "yes", "no", "not yet" or "", "why": of "no", "since": of a latch from before the start,
  /// "file"}.
  [[nodiscard]] Json json() const;

 private:
  enum class Keeping { kNothing, kPending, kKept, kFailed };
  void keep(const std::string& reason);
  void note_kept(const types::Status& outcome);
  void note_forgotten(const types::Status& outcome);
  void release();
  void fail_clears(const types::Error& error);

  sync::EStopLine<>& line_;
  std::function<const pipeline::ControlReport&()> base_;
  std::string file_;  ///< empty: nothing is kept
  Announce announce_;
  LatchKeeper keeper_;
  Keeping keeping_ = Keeping::kNothing;
  std::string why_not_;       ///< of kFailed
  std::string since_before_;  ///< what the file said at the start, until the clear
  std::uint64_t wish_ = 0;    ///< the newest
  std::vector<Done> clears_;  ///< that wait for the disk
  types::Stamp cleared_{};
};

}  // namespace topo::daemon

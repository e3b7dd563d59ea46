// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/pipeline/control_step.hpp"
#include "daemon/estop/latch_keeper.hpp"

namespace topo::daemon {

/// Keeps the silence towards a base that does not obey in a file beyond the daemon's end, so that neither the
/// next daemon nor topometric-estop feeds its watchdog. The base's thread decides; this follows its reports.
/// Main only.
class SilenceControl {
 public:
  /// `folder`: control.state_folder; empty: nothing is kept. `base`: the newest report of the base's thread.
  SilenceControl(std::function<const pipeline::ControlReport&()> base, const std::string& folder);

  /// Takes up what the file says, and starts the thread that writes it.
  types::Status start();
  /// Every tick: follows the base's report, and takes what became of the file.
  void tick(types::Stamp now);
  /// Readable when tick() has news of the file: for tests.
  [[nodiscard]] int fd() const { return keeper_.fd(); }

  /// What is wrong with the keeping; empty: nothing.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }

 private:
  void collect(types::Stamp now);

  std::function<const pipeline::ControlReport&()> base_;
  std::string file_;  ///< empty: nothing is kept
  LatchKeeper keeper_;
  bool silent_ = false;  ///< the newest wish
  std::uint64_t wish_ = 0;
  types::Stamp forget_again_{};  ///< zero: no attempt to forget has failed
  std::string trouble_;
};

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "daemon/setup/device_search.hpp"
#include "daemon/setup/dialogue.hpp"

namespace topo::daemon {

/// What `topoctl setup` shows: questions, and below those that look a picture of what each scanner sees,
/// which lives on a terminal and stands still in a script's output.
class SetupScreen {
 public:
  explicit SetupScreen(bool terminal) : terminal_(terminal) {}

  void ask(const SetupState& state, std::span<const LiveScanner> scanners);
  /// Draws the pictures anew, where it is time and they live.
  void refresh(const SetupState& state, std::span<const LiveScanner> scanners, types::Stamp now);
  /// The question was answered.
  void leave() { lines_ = 0; }
  [[nodiscard]] bool is_terminal() const { return terminal_; }

 private:
  bool terminal_;
  std::size_t lines_ = 0;  ///< of the pictures above the prompt; 0: none
  types::Stamp drawn_{};
};

}  // namespace topo::daemon

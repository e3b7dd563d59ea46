// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/stamp.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

/// Wakes one waiting thread. An event counter (eventfd) that never blocks who posts.
class Wakeup {
 public:
  Wakeup();

  /// Any thread, real-time ones too. Wait-free: one system call that adds to a counter.
  void post() noexcept;
  /// Blocks until something was posted since the last wait, or the time is over. True when something was.
  bool wait(types::Duration timeout);
  /// For a poll loop: readable when something was posted.
  [[nodiscard]] int fd() const { return fd_.get(); }

 private:
  io::UniqueFd fd_;
};

}  // namespace topo::daemon

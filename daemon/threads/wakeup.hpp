// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/types/stamp.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::daemon {

/// Wakes one waiting thread. An event counter (eventfd); post() never blocks.
class Wakeup {
 public:
  Wakeup();

  /// Callable from any thread, including real-time threads. Wait-free: one system call that adds to a
  /// counter.
  void post() noexcept;
  /// Blocks until the first post since the last wait, or the time-out. True when there was a post.
  bool wait(types::Duration timeout);
  /// For a poll loop: readable after a post.
  [[nodiscard]] int fd() const { return fd_.get(); }

 private:
  io::UniqueFd fd_;
};

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pthread.h>

#include <functional>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::daemon {

/// How a thread is run.
struct ThreadSettings {
  std::string name;       ///< at most 15 characters, as the kernel shows it
  int fifo_priority = 0;  ///< above 0: SCHED_FIFO
  int nice = 0;           ///< where fifo_priority is 0
  std::vector<int> cpus;  ///< empty: any
  std::size_t stack_bytes = 1 << 20;
};

/// One thread, joined by its destructor. The body must return when it is told to stop by other means.
class Thread {
 public:
  Thread() = default;
  ~Thread() { join(); }
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;

  /// Starts `body` with the default scheduling. kIo when the system has no thread for us.
  types::Status start(const ThreadSettings& settings, std::function<void()> body);
  void join();

 private:
  static void* enter(void* self);
  pthread_t handle_{};
  bool running_ = false;
  std::function<void()> body_;
};

/// Gives the calling thread its name, scheduling and CPUs. What was refused, one sentence each; the rest is
/// done.
std::vector<std::string> apply_settings(const ThreadSettings& settings);

/// Locks what is touched from now on into memory (MCL_ONFAULT). The error names the limit in the way.
types::Status lock_memory();

/// Whether this process may have `priority` under SCHED_FIFO, tried on the calling thread and undone.
types::Status try_fifo(int priority);

}  // namespace topo::daemon

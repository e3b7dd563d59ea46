// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pthread.h>

#include <functional>
#include <string>
#include <vector>

#include "core/types/result.hpp"

namespace topo::daemon {

/// Settings of a thread.
struct ThreadSettings {
  std::string name;       ///< at most 15 characters, as shown by the kernel
  int fifo_priority = 0;  ///< above 0: SCHED_FIFO
  int nice = 0;           ///< used when fifo_priority is 0
  std::vector<int> cpus;  ///< empty: any
  std::size_t stack_bytes = 1 << 20;
};

/// One thread, joined by its destructor. The body must return when it is stopped by other means.
class Thread {
 public:
  Thread() = default;
  ~Thread() { join(); }
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;

  /// Starts `body` with the default scheduling. kIo when the system provides no thread.
  types::Status start(const ThreadSettings& settings, std::function<void()> body);
  void join();

 private:
  static void* enter(void* self);
  pthread_t handle_{};
  bool running_ = false;
  std::function<void()> body_;
};

/// Sets the calling thread's name, scheduling and CPUs. Returns one sentence for each refused setting; the
/// others are applied.
std::vector<std::string> apply_settings(const ThreadSettings& settings);

/// Locks resident pages, and pages when they are first touched, into memory (MCL_ONFAULT). The error names
/// the limit.
types::Status lock_memory();

/// Keeps freed memory for the next period, up to 64 MB in each thread's arena. By default glibc returns most
/// of it to the system after every analysis, and the next one takes it back page by page: 360 page faults a
/// second of the planning thread (toolchain/demo, page_faults_per_s), locked or not.
void keep_freed_memory();

/// Tests whether this process may use `priority` under SCHED_FIFO: sets it for the calling thread and
/// restores it.
types::Status try_fifo(int priority);

}  // namespace topo::daemon

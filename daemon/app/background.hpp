// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "core/types/result.hpp"
#include "daemon/threads/thread.hpp"
#include "daemon/threads/wakeup.hpp"

namespace topo::daemon {

/// A thread for what would keep main from answering an e-stop: slow disks, long searches. One job after the
/// other. Locks are between main and this thread alone.
class Background {
 public:
  /// What main does with the outcome.
  using Finish = std::function<void()>;
  /// Runs on the thread; what it returns runs on main.
  using Job = std::function<Finish()>;

  Background() = default;
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background() { stop(); }

  types::Status start(const std::string& name);
  /// Finishes the job in hand; what waits is never begun, and what was finished is not told.
  void stop();

  /// Main. kBusy when too much waits, or when stopping.
  types::Status add(Job job);
  /// Main. Readable when collect() has something to do.
  [[nodiscard]] int fd() const { return finished_ready_.fd(); }
  /// Main. Runs the Finish of what was done.
  void collect();

 private:
  void run();

  Wakeup job_ready_, finished_ready_;
  std::mutex mutex_;
  std::deque<Job> waiting_;      ///< guarded by mutex_
  std::deque<Finish> finished_;  ///< guarded by mutex_
  bool stopping_ = false;        ///< guarded by mutex_
  Thread thread_;
};

}  // namespace topo::daemon

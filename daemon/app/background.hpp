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

/// A thread for work that would delay main's reaction to an e-stop: slow disks, long searches. Runs one job
/// after the other. Its locks are shared only by main and this thread.
class Background {
 public:
  /// Completion handler, called on main.
  using Finish = std::function<void()>;
  /// Runs on the thread; the returned handler runs on main.
  using Job = std::function<Finish()>;

  Background() = default;
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background() { stop(); }

  types::Status start(const std::string& name);
  /// Finishes the current job; waiting jobs are not started, and handlers of finished jobs are not called.
  void stop();

  /// Main only. kBusy when too many jobs wait, or when stopping.
  types::Status add(Job job);
  /// Main only. Readable when collect() has handlers to call.
  [[nodiscard]] int fd() const { return finished_ready_.fd(); }
  /// Main only. Calls the handlers of finished jobs.
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

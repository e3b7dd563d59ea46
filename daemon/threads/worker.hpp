// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace topo::daemon {

/// The body of one thread.
class Worker {
 public:
  Worker() = default;
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  virtual ~Worker() = default;

  /// Runs until the flag of HandOvers::ending that concerns the thread is set.
  virtual void run() noexcept = 0;
};

}  // namespace topo::daemon

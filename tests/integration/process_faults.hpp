// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

namespace topo::test {

/// Faults of the machine on which the daemon runs, for this process, in which it runs.

/// Threads that do not advance although nothing is wrong with them, as a debugger or SIGSTOP does it: a
/// signal handler holds them. One at a time in a process.
class HungThreads {
 public:
  /// Holds the threads of these names (all when empty), among those that the daemon starts; returns how many.
  static std::size_t hang(const std::vector<std::string>& names);
  static void release();
};

/// Threads that compute and never wait.
class CpuHog {
 public:
  explicit CpuHog(unsigned threads);
  ~CpuHog();
  CpuHog(const CpuHog&) = delete;
  CpuHog& operator=(const CpuHog&) = delete;

 private:
  std::atomic<bool> stop_{false};
  std::vector<std::thread> threads_;
};

/// No file of this process grows any more, as on a full disk (EFBIG in place of ENOSPC), or all may again.
void set_disk_full(bool full);

}  // namespace topo::test

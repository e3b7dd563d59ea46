// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

#include "core/types/result.hpp"

namespace topo::bench {

/// What one of the processes does: the text that it hands over. Must not use threads of the parent's.
using Work = std::function<types::Result<std::string>(std::size_t job)>;

/// Told in the parent, one job at a time, in the order in which they end. The text is whole; an error is the
/// work's own, or says how the process died. An error that it returns ends everything.
using JobDone = std::function<types::Status(std::size_t job, const types::Result<std::string>& text)>;

/// How many processes there are, and for how long.
struct WorkerLimits {
  int at_once = 1;               ///< 1 or more
  std::chrono::seconds each{0};  ///< by the clock; one that takes longer is killed
};

/// Does the jobs 0 to `count` - 1, each in a process of its own (fork without exec), begun in their order:
/// processes and not threads, so that one that crashes, hangs or eats all memory takes nothing with it. They
/// die with the parent, however it ends. The parent must have no other threads. Blocks until all have ended.
types::Status run_in_processes(std::size_t count, const WorkerLimits& limits, const Work& work,
                               const JobDone& done);

}  // namespace topo::bench

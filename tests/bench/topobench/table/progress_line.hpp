// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "tests/bench/topobench/table/table_runs.hpp"

namespace topo::bench {

/// Says on standard error how far a table is: done of all, how many crashed, the time left. On a terminal in
/// one line that changes with every run; else a line every half minute.
class ProgressLine final : public TableWatch {
 public:
  ProgressLine();
  void begun(std::size_t all, std::size_t there) override;
  void finished(const PlannedRun& run) override;
  void crashed(const PlannedRun& run, const std::string& why) override;

 private:
  using Clock = std::chrono::steady_clock;
  void say();

  bool terminal_;
  std::size_t all_ = 0, there_ = 0, done_ = 0, crashed_ = 0;
  Clock::time_point began_, said_;
};

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

namespace topo::bench {
namespace {

constexpr std::chrono::seconds kQuiet{30};

std::string hours_and_minutes(double seconds) {
  const auto minutes = static_cast<long>(seconds / 60.0 + 0.5);
  return fmt::format("{}:{:02} h", minutes / 60, minutes % 60);
}

}  // namespace

ProgressLine::ProgressLine()
    : terminal_(::isatty(STDERR_FILENO) == 1), began_(Clock::now()), said_(began_ - kQuiet) {}

void ProgressLine::begun(std::size_t all, std::size_t there) {
  all_ = all;
  there_ = there;
  began_ = Clock::now();
  fmt::print(stderr, "{} runs, {} of them done before\n", all, there);
}

void ProgressLine::finished(const PlannedRun& /*run*/) {
  ++done_;
  say();
}

void ProgressLine::crashed(const PlannedRun& run, const std::string& why) {
  ++done_;
  ++crashed_;
  fmt::print(stderr, "{}{}, {}, seed {}: no report: {}\n", terminal_ ? "\r\033[K" : "", run.key.world,
             name_of(run.key.entrant), run.key.seed, why);
  say();
}

void ProgressLine::say() {
  const Clock::time_point now = Clock::now();
  const std::size_t left = all_ - there_ - done_;
  if (!terminal_ && left > 0 && now - said_ < kQuiet) return;
  said_ = now;
  const double each_s = std::chrono::duration<double>(now - began_).count() / static_cast<double>(done_);
  fmt::print(stderr, "{}{}/{} done, {} without a report, {} left{}", terminal_ ? "\r\033[K" : "",
             there_ + done_, all_, crashed_, hours_and_minutes(each_s * static_cast<double>(left)),
             terminal_ && left > 0 ? "" : "\n");
}

}  // namespace topo::bench

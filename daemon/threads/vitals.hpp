// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/sync/event_ring.hpp"
#include "core/sync/histogram.hpp"
#include "core/types/stamp.hpp"

namespace topo::daemon {

/// A thread's state of health for other threads: one writer, any readers; every call is wait-free.
struct Vitals {
  explicit Vitals(std::string_view thread_name) : name(thread_name) {}

  void beat() noexcept { beats.store(beats.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }
  void add_overruns(std::uint64_t n) noexcept {
    overruns.store(overruns.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
  }

  std::string_view name;
  std::atomic<std::uint64_t> beats{0};
  std::atomic<std::uint64_t> overruns{0};  ///< missed whole periods
  sync::Histogram wake;                    ///< from the due time to the start of the run
  sync::Histogram run;                     ///< from the start to the end of the run
  sync::EventRing<64> events;              ///< the thread's messages; main reads and logs them
};

/// Limits the report of a persistent condition to once a minute.
class Rarely {
 public:
  static constexpr types::Duration kApart = std::chrono::minutes(1);

  /// True when the condition is to be reported now; then false for a minute, or until over().
  bool due(types::Stamp now) {
    if (told_ && now - *told_ < kApart) return false;
    told_ = now;
    return true;
  }
  void over() { told_.reset(); }

 private:
  std::optional<types::Stamp> told_;
};

/// Deadlines at whole periods from the first one. A late thread continues at the next whole period: the grid
/// never shifts, and missed periods are not made up.
class Period {
 public:
  Period(types::Stamp first, types::Duration period) : next_(first), period_(period) {}
  [[nodiscard]] types::Stamp next() const { return next_; }
  /// Advances to the first deadline after `now`; returns the number of deadlines skipped.
  std::uint64_t advance(types::Stamp now) {
    next_ += period_;
    if (next_ > now) return 0;
    const auto missed = (now - next_) / period_ + 1;
    next_ += missed * period_;
    return static_cast<std::uint64_t>(missed);
  }

 private:
  types::Stamp next_;
  types::Duration period_;
};

}  // namespace topo::daemon

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

/// What a thread lets others see of itself: one writer, any reader; every call is wait-free.
struct Vitals {
  explicit Vitals(std::string_view thread_name) : name(thread_name) {}

  void beat() noexcept { beats.store(beats.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }
  void add_overruns(std::uint64_t n) noexcept {
    overruns.store(overruns.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
  }

  std::string_view name;
  std::atomic<std::uint64_t> beats{0};
  std::atomic<std::uint64_t> overruns{0};  ///< whole periods that were missed
  sync::Histogram wake;                    ///< from when it was due to when it ran
  sync::Histogram run;                     ///< from when it ran to when it was done
  sync::EventRing<64> events;              ///< what it has to say; main reads and logs it
};

/// What goes on and on is told once a minute.
class Rarely {
 public:
  static constexpr types::Duration kApart = std::chrono::minutes(1);

  /// Whether to tell it now; then not again for a minute, or until it is over.
  bool due(types::Stamp now) {
    if (told_ && now - *told_ < kApart) return false;
    told_ = now;
    return true;
  }
  void over() { told_.reset(); }

 private:
  std::optional<types::Stamp> told_;
};

/// Deadlines at whole periods from the first one. A late thread goes on at the next whole period: the grid
/// never moves, and nothing is caught up.
class Period {
 public:
  Period(types::Stamp first, types::Duration period) : next_(first), period_(period) {}
  [[nodiscard]] types::Stamp next() const { return next_; }
  /// To the first deadline after `now`; returns how many were passed over.
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

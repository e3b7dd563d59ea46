// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

#include "core/sync/cache_line.hpp"
#include "core/sync/steps.hpp"

namespace topo::sync {

/// The operator's emergency stop, from the thread that serves operators to the base's thread. Two words
/// beside all other hand-overs, so that nothing can be in its way. Every call is wait-free. The base latches
/// what it reads (motion::update_latch); a clear never undoes a stop that was pressed after it
/// (tests/models/estop.pml).
template <class Steps = Undisturbed>
class EStopLine {
 public:
  struct Reading {
    bool pressed = false;
    bool cleared = false;  ///< at least once since the reading before
  };

  /// Operator's thread.
  void press() noexcept {
    Steps::before_step();
    pressed_.store(true, std::memory_order_release);
  }

  /// Operator's thread. The release comes first, its count second.
  void clear() noexcept {
    Steps::before_step();
    pressed_.store(false, std::memory_order_release);
    Steps::before_step();
    clears_.store(clears_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  /// Any thread.
  [[nodiscard]] bool pressed() const noexcept { return pressed_.load(std::memory_order_acquire); }

  /// Base's thread, once a period. The count is read before the button: a clear that is counted here comes
  /// behind its release, so that none is spent on a stop that is read as pressed although it is gone.
  [[nodiscard]] Reading read() noexcept {
    Steps::before_step();
    const std::uint64_t clears = clears_.load(std::memory_order_acquire);
    Reading reading;
    reading.cleared = clears != clears_seen_;
    clears_seen_ = clears;
    Steps::before_step();
    reading.pressed = pressed();
    return reading;
  }

 private:
  alignas(kCacheLine) std::atomic<bool> pressed_{false};
  std::atomic<std::uint64_t> clears_{0};
  alignas(kCacheLine) std::uint64_t clears_seen_ = 0;  ///< the base's
};

}  // namespace topo::sync

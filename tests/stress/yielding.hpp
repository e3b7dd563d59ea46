// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace topo::stress {

/// The hand-overs' policy of a stress test: every third step, drawn by a generator of each thread, is
/// preceded by a yield. On one core the other threads then run in the middle of a call, which a scheduler's
/// slice of some milliseconds lets happen once in millions of steps.
struct Yielding {
  static void before_step() noexcept {
    static std::atomic<std::uint64_t> threads{0};
    thread_local std::uint64_t dice = 88172645463325252U + threads.fetch_add(1, std::memory_order_relaxed);
    dice = dice * 6364136223846793005U + 1442695040888963407U;
    if ((dice >> 33U) % 3 == 0) std::this_thread::yield();
  }
};

}  // namespace topo::stress

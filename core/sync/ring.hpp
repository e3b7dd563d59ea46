// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/sync/cache_line.hpp"
#include "core/sync/steps.hpp"
#include "core/types/invariant.hpp"

namespace topo::sync {

/// Bounded queue of one producer and one consumer thread, filled and read in place: nothing is copied and
/// nothing allocated after construction. Never loses what it accepted: a full ring rejects, and counts. The
/// object is as large as its N slots, so it belongs in the heap or in static storage, not on a small stack.
///
/// Every call is wait-free. Which thread may call it is said at each.
template <class T, std::size_t N, class Steps = Undisturbed>
class Ring {
  static_assert(N >= 2 && (N & (N - 1)) == 0, "the number of slots is a power of two");

 public:
  Ring() = default;
  ~Ring() = default;
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  static constexpr std::size_t capacity() { return N; }

  /// Producer. The next free slot, to be filled and committed; the same one again until it is committed.
  /// Holds what was last written into it. Null, and counted as rejected, when the ring is full.
  [[nodiscard]] T* try_acquire() noexcept {
    T* slot = next_free();
    if (slot == nullptr) reject();
    return slot;
  }

  /// Producer. As try_acquire, but a full ring is not counted: for who does not know yet whether a value
  /// comes.
  [[nodiscard]] T* next_free() noexcept {
    const std::uint64_t head = producer_.head.load(std::memory_order_relaxed);
    if (head - producer_.tail_seen == N) {
      Steps::before_step();
      producer_.tail_seen = consumer_.tail.load(std::memory_order_acquire);
      if (head - producer_.tail_seen == N) return nullptr;
    }
    return &slots_[head % N];
  }

  /// Producer. Counts a value that found no free slot.
  void reject() noexcept {
    // One writer: no read-modify-write needed.
    producer_.rejected.store(producer_.rejected.load(std::memory_order_relaxed) + 1,
                             std::memory_order_relaxed);
  }

  /// Producer. Hands the slot of the last successful try_acquire over to the consumer.
  void commit() noexcept {
    const std::uint64_t head = producer_.head.load(std::memory_order_relaxed);
    types::require(head - producer_.tail_seen < N, "sync::Ring: committed without a free slot");
    Steps::before_step();
    producer_.head.store(head + 1, std::memory_order_release);
  }

  /// Producer. Copies a value in; false, and counted, when the ring is full.
  [[nodiscard]] bool try_push(const T& value) noexcept(noexcept(slots_[0] = value)) {
    T* slot = try_acquire();
    if (slot == nullptr) return false;
    *slot = value;
    commit();
    return true;
  }

  /// Consumer. The oldest value, good until pop or skip_to_newest; null when there is none.
  [[nodiscard]] const T* front() noexcept {
    const std::uint64_t tail = consumer_.tail.load(std::memory_order_relaxed);
    if (tail == consumer_.head_seen) {
      Steps::before_step();
      consumer_.head_seen = producer_.head.load(std::memory_order_acquire);
      if (tail == consumer_.head_seen) return nullptr;
    }
    return &slots_[tail % N];
  }

  /// Consumer. Gives the slot of the last front() that was not null back to the producer.
  void pop() noexcept {
    const std::uint64_t tail = consumer_.tail.load(std::memory_order_relaxed);
    types::require(tail != consumer_.head_seen, "sync::Ring: popped without a value");
    Steps::before_step();
    consumer_.tail.store(tail + 1, std::memory_order_release);
  }

  /// Consumer. Drops all but the newest value, which front() then gives. Returns and counts how many were
  /// dropped.
  std::size_t skip_to_newest() noexcept {
    const std::uint64_t tail = consumer_.tail.load(std::memory_order_relaxed);
    Steps::before_step();
    consumer_.head_seen = producer_.head.load(std::memory_order_acquire);
    if (consumer_.head_seen - tail < 2) return 0;
    const std::uint64_t dropped = consumer_.head_seen - tail - 1;
    Steps::before_step();
    consumer_.tail.store(tail + dropped, std::memory_order_release);
    consumer_.skipped.store(consumer_.skipped.load(std::memory_order_relaxed) + dropped,
                            std::memory_order_relaxed);
    return static_cast<std::size_t>(dropped);
  }

  /// Consumer: exact for what is committed, the producer may be adding. Any other thread: a figure for
  /// reports.
  [[nodiscard]] std::size_t size() const noexcept {
    const std::uint64_t tail = consumer_.tail.load(std::memory_order_acquire);
    const std::uint64_t head = producer_.head.load(std::memory_order_acquire);
    return static_cast<std::size_t>(head - tail);
  }

  /// Any thread. Values accepted, refused because the ring was full, and dropped by skip_to_newest, since
  /// construction.
  [[nodiscard]] std::uint64_t committed() const noexcept {
    return producer_.head.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t rejected() const noexcept {
    return producer_.rejected.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t skipped() const noexcept {
    return consumer_.skipped.load(std::memory_order_relaxed);
  }

 private:
  // Each side writes one line of its own, and asks for the other's only when what it saw last does not do.
  struct alignas(kCacheLine) Producer {
    std::atomic<std::uint64_t> head{0};  ///< slots ever committed
    std::uint64_t tail_seen = 0;
    std::atomic<std::uint64_t> rejected{0};
  };
  struct alignas(kCacheLine) Consumer {
    std::atomic<std::uint64_t> tail{0};  ///< slots ever given back
    std::uint64_t head_seen = 0;
    std::atomic<std::uint64_t> skipped{0};
  };

  Producer producer_;
  Consumer consumer_;
  alignas(kCacheLine) std::array<T, N> slots_{};

  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

}  // namespace topo::sync

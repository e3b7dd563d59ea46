// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "core/sync/cache_line.hpp"
#include "core/sync/steps.hpp"
#include "core/types/invariant.hpp"

namespace topo::sync {

/// Triple buffer: the newest value wins. One writer and exactly one reader thread; who has several readers
/// has one Latest each. Every call is wait-free, and nothing is allocated after construction.
template <class T, class Steps = Undisturbed>
class Latest {
 public:
  Latest() = default;
  ~Latest() = default;
  Latest(const Latest&) = delete;
  Latest& operator=(const Latest&) = delete;

  /// Writer. Storage of the next value, to be filled and published. Holds some older value.
  [[nodiscard]] T& writable() noexcept { return slots_[writer_.slot].value; }

  /// Writer. Makes what is in writable() the newest value. One that the reader never took is lost, and
  /// counted.
  void publish() noexcept {
    Steps::before_step();
    const std::uint8_t previous =
        middle_.exchange(static_cast<std::uint8_t>(writer_.slot | kFresh), std::memory_order_acq_rel);
    if ((previous & kFresh) != 0) {
      writer_.overwritten.store(writer_.overwritten.load(std::memory_order_relaxed) + 1,
                                std::memory_order_relaxed);
    }
    writer_.slot = slot_of(previous);
  }

  /// Writer. Copies a value in and publishes it.
  void store(const T& value) noexcept(noexcept(T(value))) {
    writable() = value;
    publish();
  }

  /// Reader. The newest value if it was not taken before, else null. Good until the reader's next call.
  [[nodiscard]] const T* take_new() noexcept {
    Steps::before_step();
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return nullptr;
    Steps::before_step();
    const std::uint8_t newest = middle_.exchange(reader_.slot, std::memory_order_acq_rel);
    reader_.slot = slot_of(newest);
    reader_.has_value = true;
    return &slots_[reader_.slot].value;
  }

  /// Reader. The newest value, taken before or not; null when nothing was ever published. Good until the
  /// reader's next call.
  [[nodiscard]] const T* read() noexcept {
    if (const T* fresh = take_new(); fresh != nullptr) return fresh;
    return reader_.has_value ? &slots_[reader_.slot].value : nullptr;
  }

  /// Any thread. Values that were replaced before the reader took them.
  [[nodiscard]] std::uint64_t overwritten() const noexcept {
    return writer_.overwritten.load(std::memory_order_relaxed);
  }

 private:
  /// Writer, reader and middle hold 0, 1 and 2 in some order (tests/models/latest.pml): 3 is nobody's.
  static std::uint8_t slot_of(std::uint8_t middle) noexcept {
    const std::uint8_t slot = middle & kSlotMask;
    types::require(slot < kSlots, "sync::Latest: a slot that does not exist");
    return slot;
  }

  static constexpr std::uint8_t kSlots = 3;
  static constexpr std::uint8_t kFresh = 4;
  static constexpr std::uint8_t kSlotMask = 3;

  struct alignas(kCacheLine) Slot {
    T value{};
  };
  struct alignas(kCacheLine) Writer {
    std::uint8_t slot = 0;
    std::atomic<std::uint64_t> overwritten{0};
  };
  struct alignas(kCacheLine) Reader {
    std::uint8_t slot = 1;
    bool has_value = false;
  };

  std::array<Slot, kSlots> slots_;
  Writer writer_;
  Reader reader_;
  /// The slot that belongs to neither side, and whether it holds what the reader has not taken.
  alignas(kCacheLine) std::atomic<std::uint8_t> middle_{2};
};

}  // namespace topo::sync

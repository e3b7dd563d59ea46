// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/sync/cache_line.hpp"
#include "core/sync/steps.hpp"
#include "core/types/invariant.hpp"

namespace topo::sync {

/// One writer publishes immutable values; a fixed number of named readers pin them. A pinned value stays
/// alive and as it is until its pin is dropped, whatever is published meanwhile. Only the writer destroys
/// values, in publish and reclaim, so a value may hold what is bound to the writer's thread (Patricia trees).
///
/// Each reader has two hazard slots (Michael, "Hazard pointers", 2004): it can hold the old value while it
/// takes the new. Nothing is allocated here; sequentially consistent loads and stores throughout, no fences.
///
/// After a reclaim at most 2 * kReaders old values are alive besides the current one: the scan reads every
/// slot once, into a copy, and keeps a retired value only when the copy holds it. Retired values are alive,
/// so their addresses differ, and no slot of the copy keeps two. Reading the slots anew for each value would
/// break the bound: a slot that changes between two comparisons keeps both. A value that a reader has pinned
/// is in the copy, because its slot showed it before the exchange that retired it.
/// tests/models/snapshot_cell.pml checks both.
///
///   publish, reclaim   writer; wait-free but for the destruction of old values
///   reader.pin         its reader's thread; lock-free: tries again only when a publish falls between
///   dropping a pin     its reader's thread; wait-free
///   construction, destruction, reader()   before the threads start and after they ended, or where said
template <class T, std::size_t kReaders, class Steps = Undisturbed>
class SnapshotCell {
  static_assert(kReaders >= 1);
  using Hazard = std::atomic<const T*>;

 public:
  static constexpr std::size_t kSlots = 2 * kReaders;  ///< and so many old values are alive at most

  /// Keeps one value alive. Owned by its reader's thread; may be empty. Must not outlive the cell.
  class Pin {
   public:
    Pin() = default;
    Pin(Pin&& other) noexcept
        : hazard_(std::exchange(other.hazard_, nullptr)), value_(std::exchange(other.value_, nullptr)) {}
    Pin& operator=(Pin&& other) noexcept {
      if (this != &other) {
        reset();
        hazard_ = std::exchange(other.hazard_, nullptr);
        value_ = std::exchange(other.value_, nullptr);
      }
      return *this;
    }
    Pin(const Pin&) = delete;
    Pin& operator=(const Pin&) = delete;
    ~Pin() { reset(); }

    /// Null when nothing was published yet.
    [[nodiscard]] const T* get() const { return value_; }
    const T* operator->() const { return value_; }
    const T& operator*() const { return *value_; }
    explicit operator bool() const { return value_ != nullptr; }

    void reset() {
      value_ = nullptr;
      if (hazard_ == nullptr) return;
      Steps::before_step();
      std::exchange(hazard_, nullptr)->store(nullptr, std::memory_order_seq_cst);
    }

   private:
    friend class SnapshotCell;
    Pin(Hazard* hazard, const T* value) : hazard_(hazard), value_(value) {}
    Hazard* hazard_ = nullptr;
    const T* value_ = nullptr;
  };

  /// The right of one thread at a time to pin. Its pins must be dropped before it.
  class Reader {
   public:
    Reader() = default;
    Reader(Reader&& other) noexcept : cell_(std::exchange(other.cell_, nullptr)), index_(other.index_) {}
    Reader& operator=(Reader&& other) noexcept {
      std::swap(cell_, other.cell_);
      std::swap(index_, other.index_);
      return *this;
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() {
      if (cell_ != nullptr) cell_->give_back(index_);
    }

    /// The value that is current during the call. Aborts when this reader holds two pins already.
    [[nodiscard]] Pin pin() { return cell_->pin(index_); }

   private:
    friend class SnapshotCell;
    Reader(SnapshotCell* cell, std::size_t index) : cell_(cell), index_(index) {}
    SnapshotCell* cell_ = nullptr;
    std::size_t index_ = 0;
  };

  SnapshotCell() = default;
  SnapshotCell(const SnapshotCell&) = delete;
  SnapshotCell& operator=(const SnapshotCell&) = delete;

  /// On the thread that may destroy values, when all readers are gone.
  ~SnapshotCell() {
    for (const ReaderSlots& r : readers_)
      types::require(!r.taken.load(), "snapshot cell destroyed before its readers");
    delete current_.load(std::memory_order_seq_cst);
    for (std::size_t i = 0; i < retired_count_; ++i) delete retired_[i];
  }

  /// Any thread. Takes reader number `index`; aborts when there is no such one or it is taken. Wait-free.
  [[nodiscard]] Reader reader(std::size_t index) {
    types::require(index < kReaders, "snapshot cell has no such reader");
    types::require(!readers_[index].taken.exchange(true, std::memory_order_acq_rel),
                   "snapshot cell reader taken twice");
    return Reader(this, index);
  }

  /// Writer. Makes `value` (not null) the current one and destroys old ones that nobody pins.
  void publish(std::unique_ptr<const T> value) {
    types::require(value != nullptr, "null published to a snapshot cell");
    Steps::before_step();
    const T* old = current_.exchange(value.release(), std::memory_order_seq_cst);
    if (old != nullptr) retire(old);
    reclaim();
  }

  /// Writer. Destroys old values that nobody pins any more: for a writer that publishes seldom. Returns how
  /// many stay.
  std::size_t reclaim() {
    const Shown shown = slots_now();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < retired_count_; ++i) {
      if (std::find(shown.begin(), shown.end(), retired_[i]) != shown.end()) {
        retired_[kept++] = retired_[i];
      } else {
        delete retired_[i];
      }
    }
    retired_count_ = kept;
    return kept;
  }

  /// Writer. Old values that are still alive: kSlots at most.
  [[nodiscard]] std::size_t retired() const { return retired_count_; }

  /// Writer. Its own newest value; null before the first publish.
  [[nodiscard]] const T* current() const { return current_.load(std::memory_order_seq_cst); }

 private:
  using Shown = std::array<const T*, kSlots>;

  // A line a reader: pinning does not disturb the others.
  struct alignas(kCacheLine) ReaderSlots {
    std::array<Hazard, 2> hazards{};
    std::atomic<bool> taken{false};
  };

  Pin pin(std::size_t index) {
    // Only this reader writes its slots, so a slot that it sees empty stays empty.
    auto& hazards = readers_[index].hazards;
    const bool first_free = hazards[0].load(std::memory_order_relaxed) == nullptr;
    Hazard& hazard = first_free ? hazards[0] : hazards[1];
    types::require(hazard.load(std::memory_order_relaxed) == nullptr,
                   "a reader of a snapshot cell holds three pins");
    const T* seen = current_.load(std::memory_order_seq_cst);
    while (true) {
      Steps::before_step();
      hazard.store(seen, std::memory_order_seq_cst);
      // When the value is still current after the slot shows it, the writer's scan, which comes after the
      // exchange that retires the value, sees the slot.
      Steps::before_step();
      const T* again = current_.load(std::memory_order_seq_cst);
      if (again == seen) return seen != nullptr ? Pin(&hazard, seen) : Pin();
      seen = again;
    }
  }

  void give_back(std::size_t index) {
    for (const Hazard& h : readers_[index].hazards) {
      types::require(h.load(std::memory_order_relaxed) == nullptr,
                     "a snapshot cell's reader went before its pins");
    }
    readers_[index].taken.store(false, std::memory_order_release);
  }

  void retire(const T* value) {
    types::require(retired_count_ < retired_.size(), "a snapshot cell's list of retired values is full");
    retired_[retired_count_++] = value;
  }

  /// What the hazard slots show, each read once.
  Shown slots_now() const {
    Shown shown{};
    std::size_t i = 0;
    for (const ReaderSlots& r : readers_) {
      for (const Hazard& h : r.hazards) {
        Steps::before_step();
        shown[i++] = h.load(std::memory_order_seq_cst);
      }
    }
    return shown;
  }

  alignas(kCacheLine) std::atomic<const T*> current_{nullptr};
  std::array<ReaderSlots, kReaders> readers_;
  /// At most kSlots after a reclaim; one more comes with a publish.
  alignas(kCacheLine) std::array<const T*, kSlots + 1> retired_{};
  std::size_t retired_count_ = 0;

  static_assert(std::atomic<const T*>::is_always_lock_free);
};

}  // namespace topo::sync

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

namespace topo::patricia {

/// Raw storage for objects of one type: chunks of growing size and a free list. Single-threaded. The caller
/// constructs and destroys the objects. AddressSanitizer treats freed slots as freed memory.
template <class T>
class Pool {
 public:
  Pool() = default;
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    for (const Chunk& c : chunks_) {
      unpoison(c.memory.get(), c.bytes);
    }
  }

  [[nodiscard]] void* allocate() {
    ++live_;
    if (free_ != nullptr) {
      FreeSlot* slot = free_;
      unpoison(slot, kSlotBytes);
      free_ = slot->next;
      return slot;
    }
    if (fresh_ == fresh_end_) grow();
    void* slot = fresh_;
    fresh_ += kSlotBytes;
    unpoison(slot, kSlotBytes);
    return slot;
  }

  void free(void* memory) {
    --live_;
    free_ = new (memory) FreeSlot{free_};
    poison(memory, kSlotBytes);
  }

  [[nodiscard]] std::size_t live() const { return live_; }
  [[nodiscard]] std::size_t bytes_reserved() const { return bytes_reserved_; }

 private:
  struct FreeSlot {
    FreeSlot* next;
  };
  static constexpr std::size_t kLine = 64;
  static constexpr std::size_t kFirstChunkBytes = 4096;
  static constexpr std::size_t kLastChunkBytes = std::size_t{1} << 20U;
  static constexpr std::size_t kSlotAlign = std::max(alignof(T), alignof(FreeSlot));
  static constexpr std::size_t kSlotBytes =
      (std::max(sizeof(T), sizeof(FreeSlot)) + kSlotAlign - 1) / kSlotAlign * kSlotAlign;
  static_assert(alignof(T) <= kLine);

  struct LineDelete {
    void operator()(std::byte* p) const { ::operator delete (p, std::align_val_t{kLine}); }
  };
  struct Chunk {
    std::unique_ptr<std::byte, LineDelete> memory;
    std::size_t bytes;
  };

  void grow() {
    const std::size_t doubled =
        chunks_.empty() ? kFirstChunkBytes : std::min(chunks_.back().bytes * 2, kLastChunkBytes);
    const std::size_t bytes = std::max(doubled, kSlotBytes);
    auto* memory = static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kLine}));
    chunks_.push_back({std::unique_ptr<std::byte, LineDelete>(memory), bytes});
    bytes_reserved_ += bytes;
    fresh_ = memory;
    fresh_end_ = memory + bytes / kSlotBytes * kSlotBytes;
    poison(memory, bytes);
  }

#if defined(__SANITIZE_ADDRESS__)
  static void poison(const void* p, std::size_t n) { __asan_poison_memory_region(p, n); }
  static void unpoison(const void* p, std::size_t n) { __asan_unpoison_memory_region(p, n); }
#else
  static void poison(const void*, std::size_t) {}
  static void unpoison(const void*, std::size_t) {}
#endif

  FreeSlot* free_ = nullptr;
  std::byte* fresh_ = nullptr;
  std::byte* fresh_end_ = nullptr;
  std::size_t live_ = 0;
  std::size_t bytes_reserved_ = 0;
  std::vector<Chunk> chunks_;
};

}  // namespace topo::patricia

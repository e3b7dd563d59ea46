// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>

namespace topo::patricia {

/// Copy-on-write value, for maps of large values (occupancy tiles). The intrusive reference count is not
/// atomic: copying, destroying and write() belong to one thread, which is the arena's owner when the value
/// lives in a Map (whose calls check that). read() is safe on any thread while the version is kept alive. A
/// default-constructed Cow allocates nothing and reads as a value-initialised T.
template <class T>
class Cow {
 public:
  Cow() = default;
  explicit Cow(T value) : block_(new Block{std::move(value), 1U}) {}
  Cow(const Cow& other) : block_(other.block_) {
    if (block_ != nullptr) ++block_->references;
  }
  Cow(Cow&& other) noexcept : block_(std::exchange(other.block_, nullptr)) {}
  Cow& operator=(const Cow& other) {
    Cow(other).swap(*this);
    return *this;
  }
  Cow& operator=(Cow&& other) noexcept {
    Cow(std::move(other)).swap(*this);
    return *this;
  }
  ~Cow() {
    if (block_ != nullptr && --block_->references == 0) delete block_;
  }

  [[nodiscard]] const T& read() const { return block_ != nullptr ? block_->value : kEmpty; }

  /// Returns the value for writing, cloned first when another Cow shares it. The reference is valid until
  /// this Cow is next copied: call write() again after a snapshot.
  [[nodiscard]] T& write() {
    if (block_ == nullptr) {
      block_ = new Block{T{}, 1U};
    } else if (block_->references != 1U) {
      auto* clone = new Block{block_->value, 1U};
      --block_->references;
      block_ = clone;
    }
    return block_->value;
  }

  [[nodiscard]] bool shared() const { return block_ != nullptr && block_->references != 1U; }
  void swap(Cow& other) noexcept { std::swap(block_, other.block_); }

  /// True for the same object, not for equal contents: a difference compares by pointer.
  friend bool operator==(const Cow& a, const Cow& b) { return a.block_ == b.block_; }

 private:
  struct Block {
    T value;
    std::uint32_t references;
  };
  inline static const T kEmpty{};
  Block* block_ = nullptr;
};

}  // namespace topo::patricia

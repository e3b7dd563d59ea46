// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>

namespace topo::patricia {

/// Value that is shared until it is written: what a map of large values (occupancy tiles) has in its leaves.
/// Intrusive reference count, not atomic: copying, dropping and write() belong to one thread, the arena's
/// owner when the value lives in a Map (whose calls check that). read() is for any thread while somebody
/// keeps the version alive. A default-made Cow holds nothing and reads as a value-initialised T, so an empty
/// one costs nothing.
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

  /// The value for writing; clones it first when another Cow shares it. The reference is good until this Cow
  /// is next copied: ask again after a snapshot.
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

  /// Same object, not same contents: what a difference by pointers needs.
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

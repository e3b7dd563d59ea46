// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/sync/cache_line.hpp"

namespace topo::daemon {

/// Bounded queue of bytes from one producer to one consumer thread. The bytes of one try_write() become
/// visible as a whole. Every call is wait-free and only copies; memory is allocated at construction.
class ByteRing {
 public:
  /// `capacity`: a power of two.
  explicit ByteRing(std::size_t capacity);

  /// Producer. Appends head and body, or nothing when there is no space for both.
  [[nodiscard]] bool try_write(std::span<const std::byte> head, std::span<const std::byte> body) noexcept;

  /// Consumer. Number of readable bytes.
  [[nodiscard]] std::size_t size() const noexcept;
  /// Consumer. Copies the oldest out.size() bytes; precondition: that many are readable.
  void peek(std::span<std::byte> out) const noexcept;
  /// Consumer. Drops the oldest n bytes; precondition: that many are readable.
  void drop(std::size_t n) noexcept;

  [[nodiscard]] std::size_t capacity() const noexcept { return bytes_.size(); }

 private:
  void put(std::uint64_t at, std::span<const std::byte> data) noexcept;

  std::vector<std::byte> bytes_;
  alignas(sync::kCacheLine) std::atomic<std::uint64_t> head_{0};  ///< bytes ever written, by the producer
  alignas(sync::kCacheLine) std::atomic<std::uint64_t> tail_{0};  ///< bytes ever dropped, by the consumer
};

}  // namespace topo::daemon

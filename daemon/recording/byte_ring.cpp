// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/byte_ring.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/types/invariant.hpp"

namespace topo::daemon {

ByteRing::ByteRing(std::size_t capacity) : bytes_(capacity) {
  types::require(std::has_single_bit(capacity), "daemon::ByteRing: a capacity that is no power of two");
}

void ByteRing::put(std::uint64_t at, std::span<const std::byte> data) noexcept {
  if (data.empty()) return;
  const auto begin = static_cast<std::size_t>(at & (bytes_.size() - 1));
  const std::size_t first = std::min(data.size(), bytes_.size() - begin);
  std::memcpy(bytes_.data() + begin, data.data(), first);
  if (first < data.size()) std::memcpy(bytes_.data(), data.data() + first, data.size() - first);
}

bool ByteRing::try_write(std::span<const std::byte> head, std::span<const std::byte> body) noexcept {
  const std::uint64_t at = head_.load(std::memory_order_relaxed);
  const std::uint64_t used = at - tail_.load(std::memory_order_acquire);
  if (head.size() + body.size() > bytes_.size() - used) return false;
  put(at, head);
  put(at + head.size(), body);
  head_.store(at + head.size() + body.size(), std::memory_order_release);
  return true;
}

std::size_t ByteRing::size() const noexcept {
  return static_cast<std::size_t>(head_.load(std::memory_order_acquire) -
                                  tail_.load(std::memory_order_relaxed));
}

void ByteRing::peek(std::span<std::byte> out) const noexcept {
  types::require(out.size() <= size(), "daemon::ByteRing: more bytes asked for than are there");
  if (out.empty()) return;
  const auto begin = static_cast<std::size_t>(tail_.load(std::memory_order_relaxed) & (bytes_.size() - 1));
  const std::size_t first = std::min(out.size(), bytes_.size() - begin);
  std::memcpy(out.data(), bytes_.data() + begin, first);
  if (first < out.size()) std::memcpy(out.data() + first, bytes_.data(), out.size() - first);
}

void ByteRing::drop(std::size_t n) noexcept {
  types::require(n <= size(), "daemon::ByteRing: more bytes dropped than are there");
  tail_.store(tail_.load(std::memory_order_relaxed) + n, std::memory_order_release);
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

#include "daemon/recording/byte_ring.hpp"
#include "daemon/recording/format.hpp"
#include "drivers/io/tap.hpp"

namespace topo::daemon {

/// Passes one device's bytes from the thread that uses the device to the recorder thread. Bytes that find the
/// ring full are counted, and a gap record takes their place as soon as there is space. The ByteTap calls
/// belong to one thread at a time and are wait-free; they neither allocate nor make system calls.
class ChannelTap final : public io::ByteTap {
 public:
  ChannelTap(std::uint8_t channel, std::size_t ring_bytes) : channel_(channel), ring_(ring_bytes) {}

  void on_open(types::Stamp stamp) noexcept override { put(RecordKind::kOpen, stamp, {}); }
  void on_bytes(io::Direction direction, types::Stamp stamp,
                std::span<const std::byte> bytes) noexcept override;
  void on_close(types::Stamp stamp) noexcept override { put(RecordKind::kClose, stamp, {}); }

  /// The recorder thread's side: complete encoded records.
  [[nodiscard]] ByteRing& ring() { return ring_; }
  [[nodiscard]] std::uint8_t channel() const { return channel_; }

  /// Any thread: bytes and records that found the ring full, since construction.
  [[nodiscard]] std::uint64_t lost_bytes() const { return lost_bytes_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t lost_records() const { return lost_records_.load(std::memory_order_relaxed); }

 private:
  void put(RecordKind kind, types::Stamp stamp, std::span<const std::byte> bytes) noexcept;
  bool put_gap(types::Stamp stamp) noexcept;

  std::uint8_t channel_;
  ByteRing ring_;
  std::uint64_t gap_bytes_ = 0;  ///< lost since the last gap record; used by the producer
  std::uint64_t gap_records_ = 0;
  std::atomic<std::uint64_t> lost_bytes_{0};
  std::atomic<std::uint64_t> lost_records_{0};
};

}  // namespace topo::daemon

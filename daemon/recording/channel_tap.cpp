// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/channel_tap.hpp"

#include <algorithm>

#include "core/types/bytes.hpp"

namespace topo::daemon {

void ChannelTap::on_bytes(io::Direction direction, types::Stamp stamp,
                          std::span<const std::byte> bytes) noexcept {
  const RecordKind kind =
      direction == io::Direction::kFromDevice ? RecordKind::kFromDevice : RecordKind::kToDevice;
  while (!bytes.empty()) {
    const std::size_t n = std::min(bytes.size(), kMaxRecordBytes);
    put(kind, stamp, bytes.first(n));
    bytes = bytes.subspan(n);
  }
}

bool ChannelTap::put_gap(types::Stamp stamp) noexcept {
  std::array<std::byte, 16> body{};
  types::store_le(std::span(body), 0, gap_bytes_);
  types::store_le(std::span(body), 8, gap_records_);
  const auto head = encode_record_head({channel_, RecordKind::kGap, body.size(), stamp});
  if (!ring_.try_write(head, body)) return false;
  gap_bytes_ = 0;
  gap_records_ = 0;
  return true;
}

void ChannelTap::put(RecordKind kind, types::Stamp stamp, std::span<const std::byte> bytes) noexcept {
  const auto head = encode_record_head({channel_, kind, static_cast<std::uint32_t>(bytes.size()), stamp});
  const bool gap_told = gap_records_ == 0 || put_gap(stamp);
  if (gap_told && ring_.try_write(head, bytes)) return;
  gap_bytes_ += bytes.size();
  ++gap_records_;
  // One writer: no read-modify-write needed.
  lost_bytes_.store(lost_bytes() + bytes.size(), std::memory_order_relaxed);
  lost_records_.store(lost_records() + 1, std::memory_order_relaxed);
}

}  // namespace topo::daemon

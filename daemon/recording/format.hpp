// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/types/stamp.hpp"

// The file of a raw recording, little-endian throughout:
//
//   header  "TOPOREC\0", u32 version, u32 n, n bytes of body, u64 xxh64 of all before
//           body: u64 configuration hash, i64 start on the wall clock (ns since 1970), i64 start on the
//           steady clock (ns), u16 channels, each: u16 length and name
//   frame   "TFRM", u32 packed size, u32 unpacked size, u32 mask of its channels, u64 number from 0,
//           u64 xxh64 of the packed bytes, u64 xxh64 of this head before it; then the packed bytes, one
//           zstd frame each: earlier frames stay readable when the writer is killed. A missing number is a
//           frame that could not be written.
//   record  (within frames) u8 channel, u8 kind, u16 zero, u32 length, i64 stamp on the steady clock (ns),
//           bytes. A record is never split over two frames. kGap: u64 bytes and u64 records lost before it.
namespace topo::daemon {

inline constexpr std::uint32_t kRecordingVersion = 1;
inline constexpr std::size_t kFrameTarget = 256U * 1024U;    ///< a frame is closed before it exceeds this
inline constexpr std::size_t kMaxFrameBytes = 512U * 1024U;  ///< limit of both sizes of a frame
inline constexpr std::size_t kMaxRecordBytes = 32U * 1024U;  ///< longer pieces are split into several records
inline constexpr std::size_t kMaxChannels = 32;
inline constexpr std::size_t kMaxChannelName = 255;
inline constexpr std::size_t kMaxHeaderBody = 16384;

struct RecordingHeader {
  std::uint64_t config_hash = 0;
  std::int64_t wall_start_ns = 0;
  std::int64_t steady_start_ns = 0;
  std::vector<std::string> channels;
  friend bool operator==(const RecordingHeader&, const RecordingHeader&) = default;
};

struct FrameHead {
  static constexpr std::size_t kSize = 40;
  std::uint32_t packed_bytes = 0;
  std::uint32_t raw_bytes = 0;
  std::uint32_t channel_mask = 0;
  std::uint64_t number = 0;
  std::uint64_t checksum = 0;
};

enum class RecordKind : std::uint8_t { kFromDevice, kToDevice, kOpen, kClose, kGap, kEnd };

struct RecordHead {
  static constexpr std::size_t kSize = 16;
  std::uint8_t channel = 0;
  RecordKind kind = RecordKind::kFromDevice;
  std::uint32_t length = 0;
  types::Stamp stamp{};
};

[[nodiscard]] std::vector<std::byte> encode_header(const RecordingHeader& header);

/// Why a file does not begin with a valid header; offset, value found and value expected, for a message.
struct HeaderFault {
  std::size_t offset = 0;
  std::string found;
  std::string expected;
};

struct DecodedHeader {
  std::optional<RecordingHeader> header;  ///< nothing: see fault
  std::size_t bytes = 0;                  ///< offset of the first frame
  HeaderFault fault;
};
/// `file`: the file's first bytes, at least 16 + kMaxHeaderBody + 8 of them when the file has that many.
[[nodiscard]] DecodedHeader decode_header(std::span<const std::byte> file);

[[nodiscard]] std::array<std::byte, FrameHead::kSize> encode_frame_head(const FrameHead& head);
/// Nothing when the magic, the head's checksum or the sizes are wrong.
[[nodiscard]] std::optional<FrameHead> decode_frame_head(std::span<const std::byte, FrameHead::kSize> bytes);

[[nodiscard]] std::array<std::byte, RecordHead::kSize> encode_record_head(const RecordHead& head) noexcept;
/// Nothing when kind, length or stamp are invalid. Does not check the channel.
[[nodiscard]] std::optional<RecordHead> decode_record_head(std::span<const std::byte> bytes) noexcept;

/// xxh64 with seed 0: the checksum of this project's files.
[[nodiscard]] std::uint64_t checksum(std::span<const std::byte> bytes) noexcept;

}  // namespace topo::daemon

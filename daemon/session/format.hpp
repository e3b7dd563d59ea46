// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// The file of a session, little-endian throughout: for saved sessions (NAME.session) and journals.
//
//   header  "TOPOSES\0", u32 version, u64 hash of the parameters, u64 xxh64 of all before
//   record  u32 kind, u32 packed bytes, u32 unpacked bytes, u64 xxh64 of the packed bytes, u64 xxh64 of the
//           head before it; then the packed bytes, one zstd frame each: earlier records stay readable when
//           the writer is killed
//
//   kKeyframes  keyframes, each a varint of its size and its bytes (core/slam/keyframe_codec.hpp)
//   kEdges      varint n, then the edges from number n on. Each: varint from, varint to, u8 1: a closure,
//               3 f64 T_from_to, 6 f64 upper triangle of the information
//   kPoses      varint n, then the poses from number n on; 3 f64 each
//   kEnd        varint keyframes, varint edges, varint poses: closed in order
//
// A later kEdges or kPoses replaces earlier items from its number on: a journal writes only changes.
namespace topo::daemon {

inline constexpr std::uint32_t kSessionVersion = 1;
inline constexpr std::size_t kSessionRecordBytesMax = 1U << 20U;  ///< limit of both sizes of a record

enum class SessionRecord : std::uint32_t { kKeyframes = 1, kEdges, kPoses, kEnd };

struct SessionHeader {
  static constexpr std::size_t kSize = 28;
  std::uint64_t params_hash = 0;  ///< of the map's parameters; a difference is reported, but is not a fault
};

[[nodiscard]] std::vector<std::byte> encode_session_header(const SessionHeader& header);
/// Nothing when it is missing, damaged, or of another version, which `version` returns (0: not a session).
[[nodiscard]] std::optional<SessionHeader> decode_session_header(std::span<const std::byte> file,
                                                                 std::uint32_t& version);

/// Packs a record and appends it. False, with nothing appended, when it exceeds kSessionRecordBytesMax.
[[nodiscard]] bool append_record(std::vector<std::byte>& out, SessionRecord kind,
                                 std::span<const std::byte> content);

struct ReadRecord {
  SessionRecord kind{};
  std::vector<std::byte> content;  ///< unpacked
  std::size_t bytes = 0;           ///< its size in the file
};
/// The first record in the rest of a file; nothing when it is incomplete or damaged.
[[nodiscard]] std::optional<ReadRecord> read_record(std::span<const std::byte> rest);
/// True when the rest of a file ends within its first record, and the part of the head present is undamaged.
[[nodiscard]] bool is_cut(std::span<const std::byte> rest);

}  // namespace topo::daemon

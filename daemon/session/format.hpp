// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// The file of a session, little-endian throughout: saved ones (NAME.session) and journals alike.
//
//   header  "TOPOSES\0", u32 version, u64 hash of the parameters, u64 xxh64 of all before
//   record  u32 kind, u32 packed bytes, u32 unpacked bytes, u64 xxh64 of the packed bytes, u64 xxh64 of the
//           head before it; then the packed bytes, one zstd frame of its own: what was written stays readable
//           when the writer is killed in the next one
//
//   kKeyframes  keyframes, each a varint of its size and its bytes (core/slam/keyframe_codec.hpp)
//   kEdges      varint n: edges from number n on are these. Each: varint from, varint to, u8 1: a closure,
//               3 f64 T_from_to, 6 f64 upper triangle of the information
//   kPoses      varint n: poses from number n on are these; 3 f64 each
//   kEnd        varint keyframes, varint edges, varint poses: closed in order
//
// A later kEdges or kPoses replaces what came before from its number on: a journal writes only what changed.
namespace topo::daemon {

inline constexpr std::uint32_t kSessionVersion = 1;
inline constexpr std::size_t kSessionRecordBytesMax = 1U
                                                      << 20U;  ///< neither size of a record's may be greater

enum class SessionRecord : std::uint32_t { kKeyframes = 1, kEdges, kPoses, kEnd };

struct SessionHeader {
  static constexpr std::size_t kSize = 28;
  std::uint64_t params_hash = 0;  ///< of what the map was made with; another one is worth a word, no fault
};

[[nodiscard]] std::vector<std::byte> encode_session_header(const SessionHeader& header);
/// Nothing when it is none, damaged, or of another version, which `version` then tells (0: none at all).
[[nodiscard]] std::optional<SessionHeader> decode_session_header(std::span<const std::byte> file,
                                                                 std::uint32_t& version);

/// Packs a record and appends it. False: it is greater than kSessionRecordBytesMax, nothing was appended.
[[nodiscard]] bool append_record(std::vector<std::byte>& out, SessionRecord kind,
                                 std::span<const std::byte> content);

struct ReadRecord {
  SessionRecord kind{};
  std::vector<std::byte> content;  ///< unpacked
  std::size_t bytes = 0;           ///< that it takes in the file
};
/// The record at the beginning of the rest of a file; nothing when there is no whole and undamaged one.
[[nodiscard]] std::optional<ReadRecord> read_record(std::span<const std::byte> rest);
/// Whether the rest of a file ends within its first record, whose head is undamaged as far as it is there.
[[nodiscard]] bool is_cut(std::span<const std::byte> rest);

}  // namespace topo::daemon

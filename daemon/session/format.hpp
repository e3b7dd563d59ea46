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
//   header  "TOPOSES\0", u32 version, u64 hash of the parameters, u64 xxh64 of all before. These 28 bytes
//   have
//           one form in all versions: a header that is whole names another version, one that is not is
//           damaged
//   record  "TSRC", u32 kind, u32 number of the record from 0, u32 number of its first item, u32 packed
//   bytes,
//           u32 unpacked bytes, u64 xxh64 of the packed bytes, u64 xxh64 of the head before it; then the
//           packed bytes, one zstd frame each: earlier records stay readable when the writer is killed, and
//           later ones when a record is damaged, because each says what it is and where its items belong
//
//   kKeyframes  keyframes, each a varint of its size and its bytes (core/slam/keyframe_codec.hpp)
//   kEdges      edges. Each: varint from, varint to, u8 1: a closure, 3 f64 T_from_to, 6 f64 upper triangle
//   of
//               the information, and its finder: u16 robot, u32 run (0: not known), u32 number
//   kPoses      poses, 3 f64 each
//   kEnd        varint keyframes, varint edges, varint poses: closed in order
//
// With a kEdges or kPoses all earlier items from its first one's number on are void: a journal writes only
// changes, and what changed is written up to the last item. Version 1 had neither "TSRC" nor the two numbers
// in the head: keyframes followed those before them, and edges and poses began with a varint of the first
// one's number. It is read up to the first damage. Before version 3 edges had no finders (kEdgesOld).
namespace topo::daemon {

inline constexpr std::uint32_t kSessionVersion = 3;
inline constexpr std::uint32_t kSessionVersionOld = 1;            ///< still read, as is all between
inline constexpr std::size_t kSessionRecordBytesMax = 1U << 20U;  ///< limit of both sizes of a record

enum class SessionRecord : std::uint32_t { kKeyframes = 1, kEdgesOld, kPoses, kEnd, kEdges };

struct SessionHeader {
  static constexpr std::size_t kSize = 28;
  std::uint64_t params_hash = 0;  ///< of the map's parameters; a difference is reported, but is not a fault
};

[[nodiscard]] std::vector<std::byte> encode_session_header(const SessionHeader& header);

struct DecodedSessionHeader {
  std::optional<SessionHeader> header;  ///< nothing: missing, damaged, or of a version that is not read
  bool whole = false;                   ///< it has its checksum
  std::uint32_t version = 0;  ///< what the file says, true or not; 0: it does not begin as a session
};
[[nodiscard]] DecodedSessionHeader decode_session_header(std::span<const std::byte> file);

struct SessionRecordHead {
  static constexpr std::size_t kSize = 40;
  SessionRecord kind{};
  std::uint32_t number = 0;            ///< of the record in its file, from 0
  std::optional<std::uint32_t> first;  ///< number of its first item; nothing: the content says it (version 1)
  std::uint32_t packed_bytes = 0;
  std::uint32_t raw_bytes = 0;
  std::uint64_t packed_sum = 0;

  [[nodiscard]] static std::size_t size_in(std::uint32_t version) {
    return version == kSessionVersionOld ? 28 : kSize;
  }
};

/// Packs a record and appends it. False, with nothing appended, when it exceeds kSessionRecordBytesMax.
[[nodiscard]] bool append_record(std::vector<std::byte>& out, SessionRecord kind, std::uint32_t number,
                                 std::uint32_t first, std::span<const std::byte> content);

/// The head at the beginning of the rest of a file; nothing when it is incomplete or damaged.
[[nodiscard]] std::optional<SessionRecordHead> decode_session_record_head(std::span<const std::byte> rest,
                                                                          std::uint32_t version);
/// True when the packed bytes behind that head are all there and have its checksum.
[[nodiscard]] bool is_sealed(std::span<const std::byte> rest, const SessionRecordHead& head,
                             std::uint32_t version);
/// The content of a sealed record, unpacked; nothing when it does not unpack to the size that its head says.
[[nodiscard]] std::optional<std::vector<std::byte>> unpack_record(std::span<const std::byte> rest,
                                                                  const SessionRecordHead& head,
                                                                  std::uint32_t version);

/// True when the rest of a file ends within its first record, and the part of the head present is undamaged.
[[nodiscard]] bool is_cut(std::span<const std::byte> rest, std::uint32_t version);

/// Offset of the next "TSRC" from `from` on; the file's size when there is none.
[[nodiscard]] std::size_t find_record_magic(std::span<const std::byte> file, std::size_t from);

}  // namespace topo::daemon

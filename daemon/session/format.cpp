// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/format.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>

#include "core/types/bytes.hpp"
#include "daemon/recording/format.hpp"

namespace topo::daemon {
namespace {

constexpr std::array<char, 8> kMagic{'T', 'O', 'P', 'O', 'S', 'E', 'S', '\0'};
constexpr std::array<char, 4> kRecordMagic{'T', 'S', 'R', 'C'};
constexpr int kLevel = 3;  // higher levels save only 2 % after varint encoding

template <std::size_t kBytes>
bool begins_with(std::span<const std::byte> bytes, const std::array<char, kBytes>& magic) {
  return bytes.size() >= kBytes && std::ranges::equal(bytes.first(kBytes), std::as_bytes(std::span(magic)));
}

}  // namespace

std::vector<std::byte> encode_session_header(const SessionHeader& header) {
  types::ByteWriter out;
  out.append(std::as_bytes(std::span(kMagic)));
  out.integer(kSessionVersion);
  out.integer(header.params_hash);
  out.integer(checksum(out.bytes()));
  return out.take();
}

DecodedSessionHeader decode_session_header(std::span<const std::byte> file) {
  DecodedSessionHeader decoded;
  if (file.size() < SessionHeader::kSize || !begins_with(file, kMagic)) return decoded;
  types::ByteReader in(file.subspan(kMagic.size()));
  decoded.version = in.integer<std::uint32_t>();
  const SessionHeader header{in.integer<std::uint64_t>()};
  decoded.whole = in.integer<std::uint64_t>() == checksum(file.first(SessionHeader::kSize - 8));
  if (decoded.whole && decoded.version >= kSessionVersionOld && decoded.version <= kSessionVersion)
    decoded.header = header;
  return decoded;
}

bool append_record(std::vector<std::byte>& out, SessionRecord kind, std::uint32_t number, std::uint32_t first,
                   std::span<const std::byte> content) {
  if (content.size() > kSessionRecordBytesMax) return false;
  std::vector<std::byte> packed(ZSTD_compressBound(content.size()));
  const std::size_t n = ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), kLevel);
  if (ZSTD_isError(n) != 0U || n > kSessionRecordBytesMax) return false;
  packed.resize(n);
  types::ByteWriter head;
  head.append(std::as_bytes(std::span(kRecordMagic)));
  head.integer(static_cast<std::uint32_t>(kind));
  head.integer(number);
  head.integer(first);
  head.integer(static_cast<std::uint32_t>(n));
  head.integer(static_cast<std::uint32_t>(content.size()));
  head.integer(checksum(packed));
  head.integer(checksum(head.bytes()));
  out.insert(out.end(), head.bytes().begin(), head.bytes().end());
  out.insert(out.end(), packed.begin(), packed.end());
  return true;
}

std::optional<SessionRecordHead> decode_session_record_head(std::span<const std::byte> rest,
                                                            std::uint32_t version) {
  const std::size_t size = SessionRecordHead::size_in(version);
  const bool numbered = version != kSessionVersionOld;
  if (rest.size() < size || (numbered && !begins_with(rest, kRecordMagic))) return std::nullopt;
  types::ByteReader in(rest.first(size).subspan(numbered ? kRecordMagic.size() : 0));
  SessionRecordHead head;
  head.kind = static_cast<SessionRecord>(in.integer<std::uint32_t>());
  if (numbered) {
    head.number = in.integer<std::uint32_t>();
    head.first = in.integer<std::uint32_t>();
  }
  head.packed_bytes = in.integer<std::uint32_t>();
  head.raw_bytes = in.integer<std::uint32_t>();
  head.packed_sum = in.integer<std::uint64_t>();
  const bool whole = in.integer<std::uint64_t>() == checksum(rest.first(size - 8));
  if (!whole || head.raw_bytes > kSessionRecordBytesMax) return std::nullopt;
  return head;
}

bool is_sealed(std::span<const std::byte> rest, const SessionRecordHead& head, std::uint32_t version) {
  const std::size_t size = SessionRecordHead::size_in(version);
  return head.packed_bytes <= rest.size() - size &&
         head.packed_sum == checksum(rest.subspan(size, head.packed_bytes));
}

std::optional<std::vector<std::byte>> unpack_record(std::span<const std::byte> rest,
                                                    const SessionRecordHead& head, std::uint32_t version) {
  const auto packed = rest.subspan(SessionRecordHead::size_in(version), head.packed_bytes);
  std::vector<std::byte> content(head.raw_bytes);
  const std::size_t n = ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
  if (ZSTD_isError(n) != 0U || n != content.size()) return std::nullopt;
  return content;
}

bool is_cut(std::span<const std::byte> rest, std::uint32_t version) {
  if (rest.empty()) return false;
  const std::size_t size = SessionRecordHead::size_in(version);
  if (rest.size() >= size) {
    const auto head = decode_session_record_head(rest, version);
    return head && head->packed_bytes > rest.size() - size;
  }
  const auto begun = rest.first(std::min(rest.size(), kRecordMagic.size()));
  return version == kSessionVersionOld ||
         std::ranges::equal(begun, std::as_bytes(std::span(kRecordMagic)).first(begun.size()));
}

std::size_t find_record_magic(std::span<const std::byte> file, std::size_t from) {
  const auto magic = std::as_bytes(std::span(kRecordMagic));
  const auto rest = file.subspan(std::min(from, file.size()));
  const auto found = std::search(rest.begin(), rest.end(), magic.begin(), magic.end());
  return file.size() - rest.size() + static_cast<std::size_t>(found - rest.begin());
}

}  // namespace topo::daemon

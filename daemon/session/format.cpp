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
constexpr std::size_t kRecordHead = 28;
constexpr int kLevel = 3;  // higher levels save only 2 % after varint encoding

struct RecordHead {
  SessionRecord kind{};
  std::uint32_t packed_bytes = 0, raw_bytes = 0;
  std::uint64_t packed_sum = 0;
};

/// Nothing when the head is damaged or incomplete.
std::optional<RecordHead> read_head(std::span<const std::byte> rest) {
  if (rest.size() < kRecordHead) return std::nullopt;
  types::ByteReader in(rest.first(kRecordHead));
  RecordHead head;
  head.kind = static_cast<SessionRecord>(in.integer<std::uint32_t>());
  head.packed_bytes = in.integer<std::uint32_t>();
  head.raw_bytes = in.integer<std::uint32_t>();
  head.packed_sum = in.integer<std::uint64_t>();
  const bool whole = in.integer<std::uint64_t>() == checksum(rest.first(kRecordHead - 8));
  if (!whole || head.raw_bytes > kSessionRecordBytesMax) return std::nullopt;
  return head;
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

std::optional<SessionHeader> decode_session_header(std::span<const std::byte> file, std::uint32_t& version) {
  version = 0;
  if (file.size() < SessionHeader::kSize) return std::nullopt;
  if (!std::ranges::equal(file.first(kMagic.size()), std::as_bytes(std::span(kMagic)))) return std::nullopt;
  types::ByteReader in(file.subspan(kMagic.size()));
  version = in.integer<std::uint32_t>();
  SessionHeader header{in.integer<std::uint64_t>()};
  const bool whole = in.integer<std::uint64_t>() == checksum(file.first(SessionHeader::kSize - 8));
  if (version != kSessionVersion || !whole) return std::nullopt;
  return header;
}

bool append_record(std::vector<std::byte>& out, SessionRecord kind, std::span<const std::byte> content) {
  if (content.size() > kSessionRecordBytesMax) return false;
  std::vector<std::byte> packed(ZSTD_compressBound(content.size()));
  const std::size_t n = ZSTD_compress(packed.data(), packed.size(), content.data(), content.size(), kLevel);
  if (ZSTD_isError(n) != 0U || n > kSessionRecordBytesMax) return false;
  packed.resize(n);
  types::ByteWriter head;
  head.integer(static_cast<std::uint32_t>(kind));
  head.integer(static_cast<std::uint32_t>(n));
  head.integer(static_cast<std::uint32_t>(content.size()));
  head.integer(checksum(packed));
  head.integer(checksum(head.bytes()));
  out.insert(out.end(), head.bytes().begin(), head.bytes().end());
  out.insert(out.end(), packed.begin(), packed.end());
  return true;
}

std::optional<ReadRecord> read_record(std::span<const std::byte> rest) {
  const auto head = read_head(rest);
  if (!head || head->packed_bytes > rest.size() - kRecordHead) return std::nullopt;
  const auto packed = rest.subspan(kRecordHead, head->packed_bytes);
  if (head->packed_sum != checksum(packed)) return std::nullopt;
  ReadRecord record;
  record.kind = head->kind;
  record.content.resize(head->raw_bytes);
  const std::size_t n = ZSTD_decompress(record.content.data(), head->raw_bytes, packed.data(), packed.size());
  if (ZSTD_isError(n) != 0U || n != head->raw_bytes) return std::nullopt;
  record.bytes = kRecordHead + head->packed_bytes;
  return record;
}

bool is_cut(std::span<const std::byte> rest) {
  if (rest.empty()) return false;
  if (rest.size() < kRecordHead) return true;
  const auto head = read_head(rest);
  return head && head->packed_bytes > rest.size() - kRecordHead;
}

}  // namespace topo::daemon

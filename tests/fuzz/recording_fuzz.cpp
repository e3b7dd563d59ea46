// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Recordings of any content: refused with the byte that is wrong, or read to an end with every record of a
// known channel and within its frame. A fuzzer finds no checksum by itself: the input is read as a file, as a
// file whose heads are sealed, and as the unpacked content of one good frame.
#include <zstd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/types/bytes.hpp"
#include "daemon/recording/format.hpp"
#include "daemon/recording/recording_reader.hpp"
#include "daemon/recording/summary.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace {

using namespace topo::daemon;
using topo::fuzz::MemoryFile;
using Octets = std::vector<std::byte>;

void require(bool holds) {
  if (!holds) std::abort();
}

void append(Octets& to, std::span<const std::byte> more) { to.insert(to.end(), more.begin(), more.end()); }

/// Every record once, or as many errors as there are frames at most. The number of records.
std::size_t read_all(const std::shared_ptr<const RecordingReader>& reader,
                     std::optional<std::size_t> channel = std::nullopt) {
  RecordingCursor cursor(reader, channel);
  std::size_t records = 0, errors = 0;
  while (true) {
    const auto next = cursor.next();
    if (!next) {
      require(++errors <= reader->frames() && !next.error().message.empty());
      continue;
    }
    if (!*next) return records;
    const Record& record = **next;
    require(record.channel < reader->header().channels.size() && record.bytes.size() <= kMaxFrameBytes);
    require(!channel || record.kind == RecordKind::kEnd || record.channel == *channel);
    std::uint64_t sum = 0;  // every byte can be read
    for (const std::byte b : record.bytes) sum += std::to_integer<std::uint64_t>(b);
    require(sum <= 255 * record.bytes.size());
    ++records;
  }
}

void check(std::span<const std::byte> content) {
  const MemoryFile file(content);
  const auto reader = RecordingReader::open(file.path());
  if (!reader) {
    require(reader.error().message.starts_with(file.path()));
    return;
  }
  require(!(*reader)->damage() || !(*reader)->damage()->message.empty());
  if ((*reader)->frames() == 0) return;  // a cursor's memory costs more than everything before
  const std::size_t all = read_all(*reader);
  if (!(*reader)->header().channels.empty()) require(read_all(*reader, 0) <= all);
  require(!format_summary(summarise(*reader)).empty());
}

/// Gives the header and each frame head their checksums and sizes that fit.
Octets sealed(std::span<const std::byte> content) {
  constexpr std::size_t kStart = 16, kSum = 8;
  Octets out(content.begin(), content.end());
  const std::span<std::byte> all(out);
  if (all.size() < kStart + kSum) return out;
  const std::size_t body =
      std::min<std::size_t>(topo::types::load_le<std::uint32_t>(all, 12), all.size() - kStart - kSum);
  topo::types::store_le(all, 12, static_cast<std::uint32_t>(body));
  topo::types::store_le(all, kStart + body, checksum(all.first(kStart + body)));
  for (std::size_t at = kStart + body + kSum; at + FrameHead::kSize <= all.size();) {
    const std::span<std::byte> rest = all.subspan(at);
    FrameHead head;
    head.packed_bytes = static_cast<std::uint32_t>(
        std::min<std::size_t>(topo::types::load_le<std::uint32_t>(rest, 4), rest.size() - FrameHead::kSize));
    head.raw_bytes = topo::types::load_le<std::uint32_t>(rest, 8);
    head.channel_mask = topo::types::load_le<std::uint32_t>(rest, 12);
    head.number = topo::types::load_le<std::uint64_t>(rest, 16);
    head.checksum = checksum(rest.subspan(FrameHead::kSize, head.packed_bytes));
    const auto bytes = encode_frame_head(head);
    std::copy(bytes.begin(), bytes.end(), rest.begin());
    at += FrameHead::kSize + head.packed_bytes;
  }
  return out;
}

/// A good recording whose only frame holds the input.
Octets framed(std::span<const std::byte> records) {
  RecordingHeader header;
  header.channels = {"base", "front", "coronal"};
  Octets out = encode_header(header);
  Octets packed(ZSTD_compressBound(records.size()));
  packed.resize(ZSTD_compress(packed.data(), packed.size(), records.data(), records.size(), 1));
  FrameHead head;
  head.packed_bytes = static_cast<std::uint32_t>(packed.size());
  head.raw_bytes = static_cast<std::uint32_t>(records.size());
  head.channel_mask = 0x7;
  head.checksum = checksum(packed);
  append(out, encode_frame_head(head));
  append(out, packed);
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  check(bytes);
  check(sealed(bytes));
  check(framed(bytes));
  return 0;
}

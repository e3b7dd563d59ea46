// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/summary.hpp"

#include <algorithm>

#include "core/team/exchange/wire.hpp"

namespace topo::team {
namespace {

using types::ByteReader;
using types::ByteWriter;

// u64 hash, varint items; then until the end of the body, for each stream: its key, varint first gap, varint
// items beyond the gap; when there are any: varint end less the gap, u8 bytes of the bitmap, bitmap.
std::vector<std::byte> encoded(const StreamSummary& stream) {
  ByteWriter out;
  write_stream(out, stream.key);
  out.varint(stream.first_gap);
  const std::uint32_t beyond = stream.count - stream.first_gap;
  out.varint(beyond);
  if (beyond == 0) return out.take();
  out.varint(stream.end - stream.first_gap);
  out.integer(static_cast<std::uint8_t>(stream.bitmap.size()));
  out.append(stream.bitmap);
  return out.take();
}

bool read_beyond(ByteReader& in, StreamSummary& stream, std::uint64_t beyond) {
  const std::uint64_t span = in.varint();
  const std::size_t bytes = in.integer<std::uint8_t>();
  const bool ok = in.ok() && beyond < span && span <= kNumbersMax - stream.first_gap &&
                  bytes <= kSummaryBits / 8 && bytes <= in.remaining();
  if (!ok) return false;
  stream.end = stream.first_gap + static_cast<std::uint32_t>(span);
  for (std::size_t i = 0; i < bytes; ++i)
    stream.bitmap.push_back(static_cast<std::byte>(in.integer<std::uint8_t>()));
  return true;
}

bool read_one(ByteReader& in, StreamSummary& stream) {
  bool ok = true;
  stream.key = read_stream(in, ok);
  const std::uint64_t gap = in.varint(), beyond = in.varint();
  if (!ok || !in.ok() || gap > kNumbersMax || beyond > kNumbersMax) return false;
  stream.first_gap = stream.end = static_cast<std::uint32_t>(gap);
  stream.count = static_cast<std::uint32_t>(gap + beyond);
  return beyond == 0 || read_beyond(in, stream, beyond);
}

}  // namespace

bool StreamSummary::holds(std::uint32_t number) const {
  if (number < first_gap) return true;
  const std::uint32_t bit = number - first_gap - 1;
  if (number == first_gap || bit / 8 >= bitmap.size()) return false;
  return (std::to_integer<unsigned>(bitmap[bit / 8]) >> (bit % 8) & 1U) != 0;
}

StreamSummary summary_of(const StreamKey& key, const ItemStream& stream) {
  StreamSummary summary{
      key, stream.first_gap(), static_cast<std::uint32_t>(stream.items().size()), stream.end(), {}};
  for (auto at = stream.items().lower_bound(summary.first_gap); at != stream.items().end(); ++at) {
    const std::uint32_t bit = at->first - summary.first_gap - 1;
    if (bit >= kSummaryBits) break;
    if (bit / 8 >= summary.bitmap.size()) summary.bitmap.resize(bit / 8 + 1);
    summary.bitmap[bit / 8] |= static_cast<std::byte>(1U << (bit % 8));
  }
  return summary;
}

std::vector<std::vector<std::byte>> encode_summaries(const ItemStore& store) {
  const auto begin = [&] {
    ByteWriter out;
    out.integer(store.hash());
    out.varint(store.size());
    return out;
  };
  std::vector<std::vector<std::byte>> bodies;
  ByteWriter out = begin();
  for (const auto& [key, stream] : store.streams()) {
    const std::vector<std::byte> one = encoded(summary_of(key, stream));
    if (out.bytes().size() + one.size() > kBodyBytesMax) {
      bodies.push_back(out.take());
      out = begin();
    }
    out.append(one);
  }
  bodies.push_back(out.take());
  return bodies;
}

std::optional<Summary> decode_summary(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  Summary summary;
  summary.hash = in.integer<std::uint64_t>();
  summary.items = static_cast<std::uint32_t>(std::min<std::uint64_t>(in.varint(), 0xFFFF'FFFFU));
  while (in.ok() && in.remaining() > 0) {
    if (!read_one(in, summary.streams.emplace_back())) return std::nullopt;
  }
  return in.ok() ? std::optional(std::move(summary)) : std::nullopt;
}

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/wants.hpp"

#include <algorithm>

#include "core/team/exchange/wire.hpp"

namespace topo::team {
namespace {

using types::ByteReader;
using types::ByteWriter;

// The asked origin, u32 heard; then until the end, for each stream: its key, varint covered, varint number of
// runs, each: varint (step from the end of the run before) * 2 + (1: wanted whole), then the count less one,
// or the bits of the pieces.
std::vector<std::byte> encoded(const WantRun& run, std::uint32_t last) {
  ByteWriter out;
  const bool whole = run.pieces == kAllPieces;
  out.varint(std::uint64_t{run.first - last} * 2 + (whole ? 1 : 0));
  out.varint(whole ? run.count - 1 : run.pieces);
  return out.take();
}

bool read_run(ByteReader& in, std::uint32_t last, WantRun& run) {
  const std::uint64_t step = in.varint(), more = in.varint();
  if (!in.ok() || step / 2 + last >= kNumbersMax) return false;
  run.first = last + static_cast<std::uint32_t>(step / 2);
  if (step % 2 == 0) {
    run.pieces = more;
    return more != 0;
  }
  run.count = static_cast<std::uint32_t>(std::min<std::uint64_t>(more, kNumbersMax)) + 1;
  return more < kNumbersMax && run.count <= kNumbersMax - run.first;
}

bool read_stream_wants(ByteReader& in, StreamWants& wants) {
  bool ok = true;
  wants.key = read_stream(in, ok);
  const std::uint64_t covered = in.varint();
  const std::size_t runs = in.count(2);
  ok = ok && in.ok() && covered <= kNumbersMax;
  wants.covered = ok ? static_cast<std::uint32_t>(covered) : 0;
  std::uint32_t last = 0;
  for (std::size_t i = 0; ok && i < runs; ++i) {
    ok = read_run(in, last, wants.runs.emplace_back());
    last = wants.runs.back().first + wants.runs.back().count;
  }
  return ok;
}

/// Writes the stream's runs as far as there is room; true when all fitted.
bool write_stream_wants(ByteWriter& out, const StreamWants& wants) {
  ByteWriter runs;
  std::uint32_t last = 0;
  std::size_t count = 0;
  constexpr std::size_t kHead = 20;  // key, covered, number of runs
  for (const WantRun& run : wants.runs) {
    const std::vector<std::byte> one = encoded(run, last);
    if (out.bytes().size() + kHead + runs.bytes().size() + one.size() > kBodyBytesMax) break;
    runs.append(one);
    last = run.first + run.count;
    ++count;
  }
  if (count == 0) return wants.runs.empty();
  write_stream(out, wants.key);
  out.varint(count == wants.runs.size() ? wants.covered : std::min(wants.covered, last));
  out.varint(count);
  out.append(runs.bytes());
  return count == wants.runs.size();
}

}  // namespace

std::vector<std::byte> encode_wants(const WantList& list) {
  ByteWriter out;
  write_origin(out, list.to);
  out.integer(list.heard);
  for (const StreamWants& wants : list.streams) {
    if (!write_stream_wants(out, wants)) break;
  }
  return out.take();
}

std::optional<WantList> decode_wants(std::span<const std::byte> bytes) {
  ByteReader in(bytes);
  bool ok = true;
  WantList list;
  list.to = read_origin(in, ok);
  list.heard = in.integer<std::uint32_t>();
  while (ok && in.ok() && in.remaining() > 0) ok = read_stream_wants(in, list.streams.emplace_back());
  return ok && in.ok() ? std::optional(std::move(list)) : std::nullopt;
}

}  // namespace topo::team

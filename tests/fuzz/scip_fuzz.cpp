// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What a hostile sensor may send to the parser and to the readers of its replies: no split of the bytes
// changes what is understood, and nothing comes out that does not fit its own echo.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/hokuyo/identity.hpp"
#include "drivers/hokuyo/scip_parser.hpp"

namespace {

using namespace topo::hokuyo;
using Event = ScipParser::Event;

void require(bool holds) {
  if (!holds) std::abort();
}

void read_everything(const Reply& reply) {
  SensorInfo info;
  (void)read_version(reply, info).has_value();
  if (read_parameters(reply, info)) {
    const int beams = info.step_max - info.step_min + 1;
    require(beams >= 1 && beams <= static_cast<int>(topo::types::Scan::kMaxBeams));
    require(info.rpm > 0 && info.steps_per_turn >= beams && info.distance_min_mm > 0);
  }
  read_state(reply, info);
  if (const auto time = read_time(reply)) require(*time <= 0xFFFFFF);
  require(!describe_status(reply.status()).empty());
}

/// A number that depends on everything that was understood.
std::uint64_t digest(std::span<const std::byte> bytes, std::size_t piece) {
  ScipParser parser;
  std::uint64_t sum = 14695981039346656037ULL;
  const auto add = [&](std::uint64_t value) { sum = (sum ^ value) * 1099511628211ULL; };
  while (!bytes.empty()) {
    const auto progress = parser.feed(bytes.first(std::min(piece, bytes.size())));
    require(progress.consumed > 0);
    bytes = bytes.subspan(progress.consumed);
    if (progress.event == Event::kNone) continue;
    add(static_cast<std::uint64_t>(progress.event));
    if (progress.event == Event::kReply) {
      read_everything(parser.reply());
      for (std::size_t i = 0; i < parser.reply().lines(); ++i) add(parser.reply().line(i).size());
    }
    if (progress.event == Event::kScan) {
      const RawScan& scan = parser.scan();
      require(scan.points == scan.echo.points() && scan.points <= scan.range_mm.size() &&
              scan.time_ms <= 0xFFFFFF);
      for (std::size_t i = 0; i < scan.points; ++i) {
        require(scan.range_mm[i] <= 0x3FFFF);
        add(scan.range_mm[i]);
      }
    }
  }
  return sum;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const std::uint64_t whole = digest(bytes, std::max<std::size_t>(size, 1));
  require(digest(bytes, 1) == whole);
  require(digest(bytes, 7) == whole);
  return 0;
}

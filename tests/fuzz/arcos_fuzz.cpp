// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The ARCOS parser under bytes of any kind, in reads of any size. The first byte says the size of the reads.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/pioneer/arcos_codec.hpp"
#include "drivers/pioneer/config_packet.hpp"
#include "drivers/pioneer/sip.hpp"

namespace {

using namespace topo;

void require(bool holds) {
  if (!holds) std::abort();
}

void read_packet(const pioneer::PacketView& packet) {
  require(!packet.payload.empty() && packet.payload.size() + 2 <= pioneer::kMaxCount);
  const auto status = pioneer::decode_status(packet.payload);
  if (status.has_value()) require(status->echoes <= pioneer::StatusPacket::kMaxEchoes);
  const auto config = pioneer::decode_config(packet.payload);
  require(!status.has_value() || !config.has_value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t read_size = data[0] == 0 ? size : data[0];
  auto rest = std::as_bytes(std::span(data, size)).subspan(1);
  const std::size_t fed = rest.size();
  pioneer::PacketParser parser;
  std::size_t delivered = 0;
  while (!rest.empty()) {
    auto read = rest.first(std::min(read_size, rest.size()));
    rest = rest.subspan(read.size());
    while (const auto packet = parser.next(read, types::Stamp{})) {
      read_packet(*packet);
      delivered += packet->wire_bytes();
    }
    require(read.empty());
  }
  // No byte is delivered twice, and none both delivered and skipped.
  require(delivered + parser.counters().skipped_bytes <= fed);
  return 0;
}

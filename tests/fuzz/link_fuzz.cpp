// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Messages of the socket between daemon and link, and heads of the radio's datagrams, are read without
// reading outside.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "core/types/bytes.hpp"
#include "daemon/link/link_wire.hpp"
#include "daemon/link/radio_filter.hpp"

namespace {

using namespace topo::daemon;

void expect(bool holds) {
  if (!holds) std::abort();
}

void read_as_messages(std::span<const std::byte> packet) {
  if (const auto hello = decode_hello(packet); hello && hello->version == kLinkVersion) {
    const auto again = encode_hello(*hello);
    expect(std::equal(again.begin(), again.end(), packet.begin(), packet.end()));
  }
  if (const auto stats = decode_stats(packet)) {
    const auto again = decode_stats(encode_stats(*stats));
    expect(again.has_value() && *again == *stats);
  }
  for (const char c : decode_refusal(packet)) expect(c >= ' ' && c <= '~');
}

/// The packet as a stream of heads: what passes is within its bounds, and nothing passes twice in a row.
void filter_heads(std::span<const std::byte> packet) {
  RadioFilter filter({.team = 1, .robot = 7, .version = kLinkVersion}, 5);
  topo::types::ByteReader in(packet);
  while (in.remaining() > 0) {
    const RadioHead head{.version = static_cast<std::uint16_t>(in.integer<std::uint8_t>() & 3U),
                         .robot = in.integer<std::uint16_t>(),
                         .team = in.integer<std::uint8_t>() & 1U,
                         .run = in.integer<std::uint8_t>(),
                         .number = in.integer<std::uint16_t>(),
                         .writer = in.integer<std::uint16_t>()};
    const std::size_t size = in.integer<std::uint16_t>();
    if (!in.ok()) return;
    if (filter.refuse(head, size)) continue;
    expect(head.robot >= 1 && head.robot <= kRobotMax && head.robot != 7 && head.robot == head.writer &&
           size >= 1 && size <= kDatagramMax_bytes);
    expect(filter.refuse(head, size) == LinkDrop::kRepeated);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto packet = std::as_bytes(std::span(data, size));
  read_as_messages(packet);
  filter_heads(packet);
  return 0;
}

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Datagrams of any content at a robot that is in the midst of a team's life: what is taken is sound and
// bounded, and everything goes on. A fuzzer finds no head by itself: the input is taken as it is, and as
// messages under a good head.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "core/slam/keyframe_codec.hpp"
#include "core/team/exchange/exchange.hpp"
#include "core/team/exchange/wire.hpp"

namespace {

using topo::team::Datagram;
using topo::team::DatagramHead;
using topo::team::Exchange;

constexpr std::uint32_t kTeam = 7;
constexpr std::size_t kStoreMax = 200'000, kAssemblyMax = 50'000;

void require(bool holds) {
  if (!holds) std::abort();
}

topo::types::Stamp at(double seconds) { return topo::types::stamp_from_seconds(100.0 + seconds); }

Exchange robot() {
  topo::team::ExchangeParams params;
  params.caps.store_bytes = kStoreMax;
  params.caps.assembly_bytes = kAssemblyMax;
  params.caps.peers = 4;
  params.caps.streams = 16;
  Exchange exchange({kTeam, 1, 1}, params);
  topo::slam::Keyframe keyframe;
  keyframe.id = {1, 0, 1};
  topo::slam::KeyframeContent content;
  content.hits.assign(900, topo::slam::Point(1.0F, 2.0F));
  keyframe.content = topo::slam::CodedContent(std::move(content));
  require(exchange.add_keyframe(keyframe).has_value());
  exchange.say({});
  return exchange;
}

/// The messages of a datagram under the head of a live mate.
Datagram under_head(std::span<const std::byte> messages, std::uint32_t counter) {
  topo::team::DatagramWriter writer(DatagramHead{kTeam, {2, 3}, counter});
  Datagram datagram = writer.take();
  const std::size_t room = topo::team::kDatagramBytesMax - datagram.size();
  datagram.insert(datagram.end(), messages.begin(),
                  messages.begin() + static_cast<std::ptrdiff_t>(std::min(room, messages.size())));
  return datagram;
}

void check(Exchange& exchange, double seconds) {
  for (const Datagram& datagram : exchange.datagrams(at(seconds))) {
    require(datagram.size() <= topo::team::kDatagramBytesMax);
    DatagramHead head;
    require(read_head(datagram, head) == topo::team::HeadVerdict::kGood);
  }
  const auto news = exchange.take_news(at(seconds));
  for (const auto& keyframe : news.keyframes) require(keyframe->id.origin() != topo::slam::Origin{1, 1});
  for (const auto& found : news.relations) require(check_relation(found).has_value());
  for (const auto& status : news.statuses) require(status.message.T_map_base.translation().allFinite());
  require(exchange.items().bytes() <= kStoreMax && exchange.assembly_bytes() <= kAssemblyMax + 65'536);
  require(exchange.peers(at(seconds)).size() <= 4 && exchange.items().streams().size() <= 20);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  Exchange exchange = robot();
  exchange.take(bytes, at(0.0));
  check(exchange, 0.05);
  // In two halves, as datagrams of a mate: what the first says meets the second.
  exchange.take(under_head(bytes, 1), at(0.1));
  exchange.take(under_head(bytes.subspan(size / 2), 2), at(0.15));
  for (const double seconds : {0.2, 0.6, 2.0}) check(exchange, seconds);
  return 0;
}

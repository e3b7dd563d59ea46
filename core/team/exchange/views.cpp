// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>

#include "core/slam/keyframe_codec.hpp"
#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/exchange_state.hpp"

// What is derived from the state for those outside.
namespace topo::team {
namespace {

/// Items of a stream, and about how many bytes they are.
struct Amount {
  std::size_t items = 0, bytes = 0;
};

std::size_t mean_bytes(const ItemStream* stream, ItemKind kind) {
  constexpr std::size_t kKeyframeGuess = 4'300, kSmallGuess = 80;  // while none is held
  if (stream != nullptr && !stream->items().empty()) return stream->bytes() / stream->items().size();
  return kind == ItemKind::kKeyframe ? kKeyframeGuess : kSmallGuess;
}

void add_difference(const ItemStore& store, const Peer& peer, const StreamKey& key, Amount& it_lacks,
                    Amount& we_lack) {
  const ItemStream* ours = store.stream(key);
  const auto theirs = peer.holds.find(key);
  const std::size_t here = ours != nullptr ? ours->items().size() : 0;
  const std::size_t there = theirs != peer.holds.end() ? theirs->second.count : 0;
  Amount& amount = here > there ? it_lacks : we_lack;
  const std::size_t items = here > there ? here - there : there - here;
  amount.items += items;
  amount.bytes += items * mean_bytes(ours, key.kind);
}

PeerView view_of(const ExchangeState& state, const slam::Origin& origin, const Peer& peer, types::Stamp now) {
  Amount it_lacks, we_lack;
  std::set<StreamKey> keys;
  for (const auto& [key, stream] : state.store.streams()) keys.insert(key);
  for (const auto& [key, summary] : peer.holds) keys.insert(key);
  for (const StreamKey& key : keys) add_difference(state.store, peer, key, it_lacks, we_lack);
  PeerView view;
  view.robot = origin.robot;
  view.run = origin.run;
  view.heard = peer.heard;
  view.alive = is_alive(peer, state.params.periods, now);
  view.hears_us = hears_us(peer, state.params.periods, now);
  view.same_sets = peer.hash == state.store.hash();
  view.round_trip_s = peer.link.round_trip_s();
  view.loss_in = peer.link.loss_in();
  view.loss_out = peer.link.loss_out();
  view.clock_offset_s = peer.link.clock_offset_s();
  view.it_lacks_items = it_lacks.items;
  view.it_lacks_bytes = it_lacks.bytes;
  view.lacks_here_items = we_lack.items;
  view.lacks_here_bytes = we_lack.bytes;
  return view;
}

slam::KeyframeId id_of(const StreamKey& stream, std::uint32_t number) {
  return {stream.origin.robot, number, stream.origin.run};
}

/// Calls f(id, bytes) for the items of a kind, in the order of the keys.
template <class F>
void for_each(const ItemStore& items, ItemKind kind, F f) {
  for (const auto& [key, stream] : items.streams()) {
    if (key.kind != kind) continue;
    for (const auto& [number, bytes] : stream.items()) f(id_of(key, number), *bytes);
  }
}

}  // namespace

std::vector<PeerView> views_of(const ExchangeState& state, types::Stamp now) {
  std::vector<PeerView> views;
  const PeriodParams& periods = state.params.periods;
  for (const slam::Origin& origin : state.peers.listed(state.self(), periods, now))
    views.push_back(view_of(state, origin, state.peers.all().at(origin), now));
  return views;
}

slam::KeyframeSet keyframes_of(const ItemStore& items) {
  slam::KeyframeSet set;
  for_each(items, ItemKind::kKeyframe, [&](const slam::KeyframeId&, std::span<const std::byte> bytes) {
    if (auto keyframe = slam::decode_keyframe(bytes))
      set.insert(std::make_shared<const slam::Keyframe>(std::move(*keyframe)));
  });
  return set;
}

slam::RelationLog relations_of(const ItemStore& items) {
  slam::RelationLog log;
  for_each(items, ItemKind::kRelation, [&](const slam::KeyframeId& id, std::span<const std::byte> bytes) {
    if (const auto found = decode_relation(id, bytes)) log.insert(*found);
  });
  return log;
}

std::vector<LogEntry> log_of(const ItemStore& items) {
  std::vector<LogEntry> log;
  for_each(items, ItemKind::kLog, [&](const slam::KeyframeId& id, std::span<const std::byte> bytes) {
    if (auto body = decode_log(bytes)) log.push_back({id, std::move(*body)});
  });
  return log;
}

}  // namespace topo::team

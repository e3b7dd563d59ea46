// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/exchange.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "core/slam/keyframe_codec.hpp"
#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/exchange_state.hpp"
#include "core/types/bytes.hpp"

namespace topo::team {
namespace {

using types::Errc;
using types::fail;

ItemKey key_of(ItemKind kind, const slam::KeyframeId& id) { return {{kind, id.origin()}, id.sequence}; }
slam::KeyframeId id_of(const ItemKey& key) {
  return {key.stream.origin.robot, key.number, key.stream.origin.run};
}

types::Status check_bounds(const slam::KeyframeId& id, std::size_t bytes, std::size_t bytes_max) {
  if (bytes > bytes_max)
    return fail(Errc::kInvalidInput, "item " + std::to_string(id.sequence) + ": found " +
                                         std::to_string(bytes) + " bytes, expected at most " +
                                         std::to_string(bytes_max));
  if (id.sequence >= kNumbersMax)
    return fail(Errc::kInvalidInput, "item: found number " + std::to_string(id.sequence) +
                                         ", expected one below " + std::to_string(kNumbersMax));
  return {};
}

/// An item of this run, in its turn.
types::Status add_own(ExchangeState& state, ItemKind kind, const slam::KeyframeId& id,
                      std::vector<std::byte> bytes) {
  if (id.origin() != state.self())
    return fail(Errc::kInvalidInput, "item: found robot " + std::to_string(id.robot) + ", run " +
                                         std::to_string(id.run) + ", expected this robot in this run");
  const ItemKey key = key_of(kind, id);
  if (state.store.contains(key)) return {};
  const ItemStream* stream = state.store.stream(key.stream);
  const std::uint32_t next = stream != nullptr ? stream->first_gap() : 0;
  if (id.sequence != next)
    return fail(Errc::kInvalidInput,
                "item: found number " + std::to_string(id.sequence) + ", expected " + std::to_string(next));
  store_item(state, key, std::move(bytes));
  return {};
}

types::Status check_entry(const LogBody& body, std::span<const std::byte> bytes) {
  const auto again = decode_log(bytes);
  if (!again || *again != body)
    return fail(Errc::kInvalidInput,
                "log entry: found a place that is not finite or beyond 100 km, or an area of "
                "less than 3 or more than 60 corners");
  return {};
}

/// The next entry of this run's log. Precondition: it was checked.
EntryId append(ExchangeState& state, const LogBody& body) {
  const StreamKey stream{ItemKind::kLog, state.self()};
  const ItemStream* log = state.store.stream(stream);
  const ItemKey key{stream, log != nullptr ? log->end() : 0};
  store_item(state, key, encode_log(body));
  state.unread.entries.push_back(key);
  return id_of(key);
}

std::vector<HeardStatus> take_statuses(ExchangeState& state, types::Stamp now) {
  std::vector<HeardStatus> statuses;
  for (const slam::Origin& origin : state.peers.listed(state.self(), state.params.periods, now)) {
    Peer& peer = *state.peers.find(origin);
    if (!std::exchange(peer.status_is_new, false) || origin.robot == state.identity.robot) continue;
    HeardStatus heard{*peer.status, origin.run, peer.said};
    LogPlaces places = places_of(state.store, origin);
    heard.message.visited = std::move(places.visited);
    heard.message.looked = std::move(places.looked);
    statuses.push_back(std::move(heard));
  }
  return statuses;
}

}  // namespace

Exchange::Exchange(const ExchangeIdentity& identity, const ExchangeParams& params)
    : state_(std::make_unique<State>(identity, params)) {}
Exchange::~Exchange() = default;
Exchange::Exchange(const Exchange& other) : state_(std::make_unique<State>(*other.state_)) {}
Exchange& Exchange::operator=(const Exchange& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
Exchange::Exchange(Exchange&& other) noexcept = default;
Exchange& Exchange::operator=(Exchange&& other) noexcept = default;

types::Status Exchange::add_keyframe(const slam::Keyframe& keyframe) {
  std::vector<std::byte> bytes = slam::encode_keyframe(keyframe);
  if (auto status = check_bounds(keyframe.id, bytes.size(), kItemBytesMax); !status) return status;
  return add_own(*state_, ItemKind::kKeyframe, keyframe.id, std::move(bytes));
}

types::Status Exchange::add_relation(const slam::FoundRelation& found) {
  std::vector<std::byte> bytes = encode_relation(found);
  if (auto status = check_item(key_of(ItemKind::kRelation, found.id), bytes); !status) return status;
  if (auto status = check_bounds(found.id, bytes.size(), kSmallItemBytesMax); !status) return status;
  return add_own(*state_, ItemKind::kRelation, found.id, std::move(bytes));
}

types::Result<EntryId> Exchange::add_entry(const LogBody& body) {
  if (const auto status = check_entry(body, encode_log(body)); !status) return tl::unexpected(status.error());
  return append(*state_, body);
}

types::Status Exchange::restore_keyframe(const slam::Keyframe& keyframe) {
  std::vector<std::byte> bytes = slam::encode_keyframe(keyframe);
  if (auto status = check_bounds(keyframe.id, bytes.size(), kItemBytesMax); !status) return status;
  store_item(*state_, key_of(ItemKind::kKeyframe, keyframe.id), std::move(bytes));
  return {};
}

types::Status Exchange::restore_relation(const slam::FoundRelation& found) {
  std::vector<std::byte> bytes = encode_relation(found);
  if (auto status = check_bounds(found.id, bytes.size(), kSmallItemBytesMax); !status) return status;
  if (auto status = check_item(key_of(ItemKind::kRelation, found.id), bytes); !status) return status;
  store_item(*state_, key_of(ItemKind::kRelation, found.id), std::move(bytes));
  return {};
}

types::Status Exchange::restore_entry(const LogEntry& entry) {
  std::vector<std::byte> bytes = encode_log(entry.body);
  if (auto status = check_bounds(entry.id, bytes.size(), kSmallItemBytesMax); !status) return status;
  if (auto status = check_entry(entry.body, bytes); !status) return status;
  store_item(*state_, key_of(ItemKind::kLog, entry.id), std::move(bytes));
  return {};
}

void Exchange::say(const StatusMessage& status) {
  for (const LogBody& body : changes(places_of(state_->store, state_->self()), status)) {
    if (check_entry(body, encode_log(body))) append(*state_, body);
  }
  StatusMessage said = status;
  said.robot = state_->identity.robot;
  said.sequence = ++state_->sender.statuses;
  state_->sender.said = std::move(said);
}

EntryId Exchange::order(const Order& order, types::Stamp now) {
  const EntryId id = append(*state_, order);
  state_->orders.repeat(id, {}, now, order.to);
  return id;
}

void Exchange::acknowledge(const EntryId& order, types::Stamp /*now*/, std::string_view refused) {
  const std::uint16_t robot = state_->identity.robot;
  const auto shown = std::as_bytes(std::span(refused.substr(0, kRefusalBytesMax)));
  if (!state_->orders.has_acknowledged(robot, order))
    append(*state_, Acknowledgement{order, types::ByteReader(shown).text()});
  state_->orders.send_acknowledgement(robot, order);
}

std::map<std::uint16_t, std::string> Exchange::refused_by(const EntryId& order) const {
  return state_->orders.refused_by(order);
}

std::vector<std::uint16_t> Exchange::acknowledged_by(const EntryId& order) const {
  return state_->orders.acknowledged_by(order);
}

void Exchange::take(std::span<const std::byte> datagram, types::Stamp now,
                    std::optional<std::uint16_t> sender) {
  take_datagram(*state_, datagram, now, sender);
}

std::vector<Datagram> Exchange::datagrams(types::Stamp now) { return make_datagrams(*state_, now); }

ExchangeNews Exchange::take_news(types::Stamp now, bool room) {
  ExchangeNews news;
  Unread& unread = state_->unread;
  const ItemStore& store = state_->store;
  const CapParams& caps = state_->params.caps;
  // All of it was checked when it came: what does not decode cannot be here.
  for (; room && !unread.keyframes.empty() && news.keyframes.size() < caps.news_keyframes;
       unread.keyframes.pop_front()) {
    if (auto keyframe = slam::decode_keyframe(*store.find(unread.keyframes.front())))
      news.keyframes.push_back(std::make_shared<const slam::Keyframe>(std::move(*keyframe)));
  }
  for (; room && !unread.relations.empty() && news.relations.size() < caps.news_relations;
       unread.relations.pop_front()) {
    const ItemKey& key = unread.relations.front();
    if (auto found = decode_relation(id_of(key), *store.find(key))) news.relations.push_back(*found);
  }
  for (; !unread.entries.empty(); unread.entries.pop_front()) {
    const ItemKey& key = unread.entries.front();
    if (auto body = decode_log(*store.find(key))) news.entries.push_back({id_of(key), std::move(*body)});
  }
  news.orders = std::exchange(unread.orders, {});
  news.statuses = take_statuses(*state_, now);
  if (now - unread.duplicates_told >= types::from_seconds(state_->params.periods.alive_s)) {
    news.duplicates = state_->peers.duplicates(state_->self(), state_->params.periods, now);
    const auto [robot, run] = state_->self();
    if (std::exchange(unread.same_run_heard, false)) news.duplicates.push_back({robot, run, run, true});
    if (!news.duplicates.empty()) unread.duplicates_told = now;
  }
  return news;
}

std::vector<PeerView> Exchange::peers(types::Stamp now) const { return views_of(*state_, now); }
const ExchangeCounters& Exchange::counters() const { return state_->counters; }
const ExchangeIdentity& Exchange::identity() const { return state_->identity; }
const ItemStore& Exchange::items() const { return state_->store; }
std::size_t Exchange::assembly_bytes() const { return state_->assemblies.bytes(); }

}  // namespace topo::team

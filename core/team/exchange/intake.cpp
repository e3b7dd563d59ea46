// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/coding.hpp"
#include "core/team/exchange/exchange_state.hpp"
#include "core/team/exchange/wire.hpp"

namespace topo::team {

Stored store_item(ExchangeState& state, const ItemKey& key, std::vector<std::byte> bytes) {
  const Stored stored =
      state.store.insert(key, std::make_shared<const std::vector<std::byte>>(std::move(bytes)));
  if (stored != Stored::kNew || key.stream.kind != ItemKind::kLog) return stored;
  const EntryId id{key.stream.origin.robot, key.number, key.stream.origin.run};
  const auto body = decode_log(*state.store.find(key));
  if (const auto* done = body ? std::get_if<Acknowledgement>(&*body) : nullptr) {
    state.orders.note(*done, id);
    if (state.orders.is_urgent(done->order)) state.orders.send_acknowledgement(id.robot, done->order);
  }
  return stored;
}

namespace {

/// The messages of one datagram.
class Intake {
 public:
  Intake(ExchangeState& state, const DatagramHead& head, Peer& peer, types::Stamp now)
      : state_(state), head_(head), peer_(peer), now_(now) {}

  /// False for a malformed one.
  bool take(const Message& message) {
    switch (static_cast<MessageKind>(message.kind)) {
      case MessageKind::kPresence:
        return take_presence(message.body);
      case MessageKind::kStatus:
        return take_status(message.body);
      case MessageKind::kSummary:
        return take_summary(message.body);
      case MessageKind::kWants:
        return take_wants(message.body);
      case MessageKind::kOrder:
        return take_order(message.body);
      case MessageKind::kLog:
        return take_small(ItemKind::kLog, message.body);
      case MessageKind::kRelation:
        return take_small(ItemKind::kRelation, message.body);
      case MessageKind::kPiece:
        return take_piece(message.body);
      case MessageKind::kCoded:
        return take_coded(message.body);
    }
    ++state_.counters.other_version;  // of a later program: the rest is of use
    return true;
  }

 private:
  bool is_newest(std::optional<std::uint32_t>& newest) {
    if (is_newer(newest, head_.counter)) return true;
    ++state_.counters.replayed;
    return false;
  }

  bool take_presence(std::span<const std::byte> body) {
    const auto presence = decode_presence(body);
    if (!presence) return false;
    if (!is_newest(peer_.presence_at)) return true;
    std::optional<Echo> ours;
    for (const Echo& echo : presence->echoes) {
      if (echo.mate == state_.self()) ours = echo;
    }
    if (ours) peer_.heard_us = now_;
    peer_.link.note_presence(presence->stamp_ms, ours, now_);
    return true;
  }

  bool take_status(std::span<const std::byte> body) {
    auto status = decode_status(head_.sender.robot, body);
    if (!status) return false;
    if (!is_newest(peer_.status_at)) return true;
    peer_.status = std::move(*status);
    peer_.said = now_;
    peer_.status_is_new = true;
    return true;
  }

  /// Several of them in one datagram describe one state.
  bool take_summary(std::span<const std::byte> body) {
    auto summary = decode_summary(body);
    if (!summary) return false;
    if (peer_.summary_at != head_.counter && !is_newest(peer_.summary_at)) return true;
    peer_.hash = summary->hash;
    for (StreamSummary& stream : summary->streams) {
      if (peer_.holds.size() >= state_.params.caps.streams && !peer_.holds.contains(stream.key)) {
        ++state_.counters.too_many;
        continue;
      }
      const StreamKey key = stream.key;
      peer_.holds[key] = std::move(stream);
    }
    return true;
  }

  bool take_wants(std::span<const std::byte> body) {
    auto wants = decode_wants(body);
    if (!wants) return false;
    if (wants->to != state_.self() || !is_newest(peer_.wants_at)) return true;
    peer_.wants = std::move(*wants);
    peer_.wanted = now_;
    return true;
  }

  bool take_order(std::span<const std::byte> body) {
    types::ByteReader in(body);
    bool ok = true;
    const ItemKey key{{ItemKind::kLog, read_origin(in, ok)}, 0};
    const std::uint64_t number = in.varint(), age_ms = in.varint();
    if (!ok || !in.ok() || number >= kNumbersMax) return false;
    const auto bytes = body.last(in.remaining());
    const auto entry = decode_log(bytes);
    const auto* order = entry ? std::get_if<Order>(&*entry) : nullptr;
    if (order == nullptr) return false;
    const ItemKey item{key.stream, static_cast<std::uint32_t>(number)};
    const EntryId id{item.stream.origin.robot, item.number, item.stream.origin.run};
    const ItemBytes held = state_.store.find(item);
    if (held == nullptr) accept(item, {bytes.begin(), bytes.end()}, true);
    if (const ItemBytes now_held = state_.store.find(item);
        now_held == nullptr || !std::ranges::equal(*now_held, bytes))
      return true;
    heard_order(id, *order, std::chrono::milliseconds(std::min<std::uint64_t>(age_ms, 86'400'000)));
    return true;
  }

  void heard_order(const EntryId& id, const Order& order, types::Duration age) {
    const std::uint16_t robot = state_.identity.robot;
    const bool own = id.origin() == state_.self();
    if (!own && state_.orders.has_acknowledged(robot, id)) state_.orders.send_acknowledgement(robot, id);
    if (age > types::from_seconds(state_.params.periods.order_repeat_s)) return;
    if (own || !state_.orders.repeat(id, age, now_, order.to)) return;
    if (order.is_for(robot)) state_.unread.orders.push_back({id, order, age});
  }

  bool take_small(ItemKind kind, std::span<const std::byte> body) {
    types::ByteReader in(body);
    bool ok = true;
    const ItemKey key = read_key(in, ok);
    if (!ok || key.stream.kind != kind || in.remaining() > kSmallItemBytesMax) return false;
    const auto bytes = body.last(in.remaining());
    accept(key, {bytes.begin(), bytes.end()}, false);
    return true;
  }

  bool take_piece(std::span<const std::byte> body) {
    types::ByteReader in(body);
    bool ok = true;
    const PieceHead head = read_piece_head(in, ok);
    if (!ok || in.remaining() != span_of(head.total, head.index).size) return false;
    add_piece(head, body.last(in.remaining()));
    return true;
  }

  bool take_coded(std::span<const std::byte> body) {
    const auto coded = decode_coded(body);
    if (!coded) return false;
    const std::vector<std::byte> a = held(coded->a), b = held(coded->b);
    if (a.empty() == b.empty()) {
      state_.counters.repeated += a.empty() ? 0U : 1U;
      return true;
    }
    const PieceHead& wanted = a.empty() ? coded->a : coded->b;
    add_piece(wanted, uncoded(*coded, a.empty() ? b : a, span_of(wanted.total, wanted.index).size));
    return true;
  }

  /// The bytes of a piece that is held, complete or not; empty when it is not.
  [[nodiscard]] std::vector<std::byte> held(const PieceHead& head) const {
    std::span<const std::byte> bytes;
    if (const ItemBytes item = state_.store.find(head.key)) {
      if (item->size() == head.total && check_of(*item) == head.check) bytes = piece_of(*item, head.index);
    } else {
      bytes = state_.assemblies.find(head);
    }
    return {bytes.begin(), bytes.end()};
  }

  void add_piece(const PieceHead& head, std::span<const std::byte> payload) {
    if (!may_enter(head.key, head.total)) return;
    if (const ItemBytes item = state_.store.find(head.key)) {
      const bool same = item->size() == head.total && check_of(*item) == head.check;
      ++(same ? state_.counters.repeated : state_.counters.contradicting);
      if (same || !std::ranges::lexicographical_compare(payload, piece_of_other(*item, head))) return;
    }
    const Piece piece = state_.assemblies.add(head, payload);
    if (piece == Piece::kHeld) ++state_.counters.repeated;
    if (piece == Piece::kOtherBytes) ++state_.counters.contradicting;
    if (auto bytes = state_.assemblies.take_complete(head.key)) {
      if (check_of(*bytes) == head.check)
        accept(head.key, std::move(*bytes), false);
      else
        ++state_.counters.malformed_item;
    }
  }

  /// Of an item that is held with other bytes, what stands at the place of a piece.
  static std::span<const std::byte> piece_of_other(std::span<const std::byte> bytes, const PieceHead& head) {
    const PieceSpan span = span_of(head.total, head.index);
    return span.begin < bytes.size() ? bytes.subspan(span.begin) : std::span<const std::byte>{};
  }

  /// What would exceed a cap, or pretends to be this run's own, is counted and stays out.
  bool may_enter(const ItemKey& key, std::size_t bytes) {
    if (state_.store.contains(key)) return true;
    if (key.stream.origin == state_.self()) {
      ++state_.counters.claims_ours;
      return false;
    }
    const CapParams& caps = state_.params.caps;
    const bool new_stream = state_.store.stream(key.stream) == nullptr;
    if (state_.store.bytes() + bytes <= caps.store_bytes &&
        !(new_stream && state_.store.streams().size() >= caps.streams))
      return true;
    ++state_.counters.too_many;
    return false;
  }

  void accept(const ItemKey& key, std::vector<std::byte> bytes, bool as_order) {
    if (!may_enter(key, bytes.size())) return;
    if (const ItemBytes held = state_.store.find(key)) {
      ++(*held == bytes ? state_.counters.repeated : state_.counters.contradicting);
      if (*held <= bytes || key.stream.origin == state_.self()) return;
    }
    if (!check_item(key, bytes)) {
      ++state_.counters.malformed_item;
      return;
    }
    const Stored stored = store_item(state_, key, std::move(bytes));
    if (stored == Stored::kNew || stored == Stored::kReplaced) tell(key, as_order);
  }

  void tell(const ItemKey& key, bool as_order) {
    Unread& unread = state_.unread;
    if (key.stream.kind == ItemKind::kKeyframe) unread.keyframes.push_back(key);
    if (key.stream.kind == ItemKind::kRelation) unread.relations.push_back(key);
    if (key.stream.kind != ItemKind::kLog) return;
    unread.entries.push_back(key);
    const auto body = decode_log(*state_.store.find(key));
    const auto* order = body ? std::get_if<Order>(&*body) : nullptr;
    if (order == nullptr || as_order || !order->is_for(state_.identity.robot)) return;
    const auto& [robot, run] = key.stream.origin;
    unread.orders.push_back({{robot, key.number, run}, *order, std::nullopt});
  }

  ExchangeState& state_;
  const DatagramHead& head_;
  Peer& peer_;
  types::Stamp now_;
};

/// Counts a datagram that is not for this robot; true when it is.
bool is_for_us(ExchangeState& state, HeadVerdict verdict, const DatagramHead& head) {
  ExchangeCounters& counters = state.counters;
  if (verdict == HeadVerdict::kMalformed)
    ++counters.malformed;
  else if (verdict == HeadVerdict::kOtherVersion)
    ++counters.other_version;
  else if (head.team != state.identity.team)
    ++counters.other_team;
  else if (head.sender != state.self())
    return true;
  else if (is_later(state.sender.counter, head.counter))
    ++counters.own_echo;
  else {
    ++counters.duplicate_ids;  // this robot has not sent so many
    state.unread.same_run_heard = true;
  }
  return false;
}

/// A mate that was out of reach gets a summary soon.
void greet(ExchangeState& state, const slam::Origin& sender, types::Stamp now) {
  const Peer* before = state.peers.find(sender);
  if (before == nullptr || !is_alive(*before, state.params.periods, now)) state.sender.summary.hasten(now);
}

}  // namespace

void take_datagram(ExchangeState& state, std::span<const std::byte> datagram, types::Stamp now,
                   std::optional<std::uint16_t> sender) {
  ++state.counters.received;
  state.counters.received_bytes += datagram.size();
  DatagramHead head;
  const HeadVerdict verdict = read_head(datagram, head);
  if (verdict == HeadVerdict::kGood && sender && head.sender.robot != *sender) {
    ++state.counters.false_number;
    return;
  }
  if (!is_for_us(state, verdict, head)) return;
  greet(state, head.sender, now);
  const Hearing hearing = state.peers.hear(head.sender, head.counter, state.params, now);
  if (hearing == Hearing::kRepeated) ++state.counters.replayed;
  if (hearing == Hearing::kTooMany) ++state.counters.too_many;
  if (hearing != Hearing::kFresh) return;
  if (state.peers.is_double(head.sender.robot, state.self(), state.params.periods, now)) {
    ++state.counters.duplicate_ids;
    return;
  }
  Peer& peer = *state.peers.find(head.sender);
  Intake intake(state, head, peer, now);
  MessageReader messages(datagram);
  bool sound = true;
  while (const auto message = messages.next()) sound = intake.take(*message) && sound;
  if (!sound || !messages.ok()) ++state.counters.malformed;
}

}  // namespace topo::team

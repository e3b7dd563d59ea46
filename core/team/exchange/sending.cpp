// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "core/team/exchange/codecs.hpp"
#include "core/team/exchange/coding.hpp"
#include "core/team/exchange/exchange_state.hpp"
#include "core/team/exchange/wire.hpp"

namespace topo::team {
namespace {

using types::ByteWriter;

constexpr std::uint64_t kNewestEvery = 4;  // a quarter of the pieces: the newest first
constexpr std::uint64_t kRelationsEvery =
    8;  // after so many pieces a datagram of relations: about two a keyframe

/// Fills datagrams one after the other.
class Outbox {
 public:
  explicit Outbox(ExchangeState& state) : state_(state) {}

  /// In the present datagram, else in the next one. The counter of the datagram.
  std::uint32_t add(MessageKind kind, std::span<const std::byte> body) {
    if (writer_ && !writer_->fits(body.size())) flush();
    if (!writer_) writer_.emplace(DatagramHead{state_.identity.team, state_.self(), state_.sender.counter});
    writer_->add(kind, body);
    state_.counters.sent_bytes_of[static_cast<std::size_t>(kind)] += body.size();
    return state_.sender.counter;
  }
  [[nodiscard]] bool fits(std::size_t body_bytes) const { return writer_ && writer_->fits(body_bytes); }
  [[nodiscard]] double bytes() const {
    return done_bytes_ + (writer_ ? static_cast<double>(writer_->size()) : 0.0);
  }
  void flush() {
    if (!writer_) return;
    ++state_.sender.counter;
    ++state_.counters.sent;
    state_.counters.sent_bytes += writer_->size();
    done_bytes_ += static_cast<double>(writer_->size());
    done_.push_back(writer_->take());
    writer_.reset();
  }
  [[nodiscard]] std::vector<Datagram> take() {
    flush();
    return std::move(done_);
  }

 private:
  ExchangeState& state_;
  std::optional<DatagramWriter> writer_;
  std::vector<Datagram> done_;
  double done_bytes_ = 0.0;
};

std::vector<std::byte> item_body(const ItemKey& key, std::span<const std::byte> bytes) {
  ByteWriter out;
  write_key(out, key);
  out.append(bytes);
  return out.take();
}

ItemKey entry_key(const EntryId& id) { return {{ItemKind::kLog, id.origin()}, id.sequence}; }

class Composer {
 public:
  Composer(ExchangeState& state, types::Stamp now)
      : state_(state), sender_(state.sender), out_(state), now_(now) {}

  std::vector<Datagram> compose() {
    const std::vector<const Peer*> mates = wanting(state_.peers, state_.self(), periods(), now_);
    Due due = find_due(mates, state_.store, sender_.sent, state_.params.caps);
    refill(due.wanted_bytes);
    add_orders();
    if (sender_.budget.bytes() >= 0.0) add_words();
    if (due.bytes == 0) push_own();  // what was lost goes first
    add_items(std::move(due), mates);
    std::vector<Datagram> datagrams = out_.take();
    sender_.budget.spend(copies() * out_.bytes());
    return datagrams;
  }

 private:
  [[nodiscard]] const PeriodParams& periods() const { return state_.params.periods; }

  /// How often the carrier sends a datagram.
  [[nodiscard]] double copies() const {
    if (!state_.params.rates.unicast) return 1.0;
    const auto alive =
        std::count_if(state_.peers.all().begin(), state_.peers.all().end(),
                      [&](const auto& entry) { return is_alive(entry.second, periods(), now_); });
    return static_cast<double>(std::max<std::ptrdiff_t>(alive, 1));
  }

  void refill(std::size_t wanted_bytes) {
    const RateParams& rates = state_.params.rates;
    const std::size_t bound = sender_.catching_up ? rates.caught_up_bytes : rates.catch_up_over_bytes;
    sender_.catching_up = wanted_bytes > bound;
    const double rate = sender_.catching_up ? rates.catch_up_bytes_per_s : rates.steady_bytes_per_s;
    const double burst = std::max(rates.burst_s * rate, 2.0 * static_cast<double>(kDatagramBytesMax));
    sender_.budget.refill(rate, burst, now_);
  }

  [[nodiscard]] bool is_awaited(const UrgentOrder& order) const {
    return std::ranges::any_of(state_.peers.all(), [&](const auto& entry) {
      const std::uint16_t robot = entry.first.robot;
      return robot != order.id.robot && robot != state_.identity.robot && (!order.to || *order.to == robot) &&
             is_alive(entry.second, periods(), now_) && !state_.orders.has_acknowledged(robot, order.id);
    });
  }

  void add_orders() {
    state_.orders.expire(periods(), now_);
    for (UrgentOrder& order : state_.orders.urgent()) {
      const ItemBytes bytes = state_.store.find(entry_key(order.id));
      if (bytes == nullptr || !order.next.is_due(now_) || !is_awaited(order)) continue;
      const auto age = std::chrono::duration_cast<std::chrono::milliseconds>(now_ - order.since + order.age);
      ByteWriter out;
      write_origin(out, order.id.origin());
      out.varint(order.id.sequence);
      out.varint(static_cast<std::uint64_t>(std::max<std::int64_t>(age.count(), 0)));
      out.append(*bytes);
      out_.add(MessageKind::kOrder, out.bytes());
      order.next.done(now_, periods().order_s, periods().jitter);
    }
    for (const EntryId& id : state_.orders.take_to_send()) {
      if (const ItemBytes bytes = state_.store.find(entry_key(id)))
        out_.add(MessageKind::kLog, item_body(entry_key(id), *bytes));
    }
  }

  /// Presence, status, summary and wants: bounded by their periods.
  void add_words() {
    if (sender_.presence.is_due(now_)) {
      add_presence();
      sender_.presence.done(now_, periods().presence_s, periods().jitter);
    }
    if (sender_.said && sender_.status.is_due(now_)) {
      out_.add(MessageKind::kStatus, encode_status(*sender_.said, kBodyBytesMax));
      sender_.said.reset();
      sender_.status.done(now_, periods().status_s, 0.0);
    }
    if (sender_.summary_hash != state_.store.hash())
      sender_.summary.hasten(sender_.summarised + types::from_seconds(periods().summary_s));
    if (sender_.summary.is_due(now_)) add_summary();
    if (sender_.wants.is_due(now_)) add_wants();
  }

  void add_presence() {
    Presence presence{in_ms(now_), {}};
    for (const auto& [origin, peer] : state_.peers.all()) {
      if (is_alive(peer, periods(), now_)) presence.echoes.push_back(peer.link.echo(origin, now_));
    }
    out_.add(MessageKind::kPresence, encode_presence(presence));
  }

  void add_summary() {
    for (const auto& body : encode_summaries(state_.store)) out_.add(MessageKind::kSummary, body);
    sender_.summary_hash = state_.store.hash();
    sender_.summarised = now_;
    sender_.summary.done(now_, periods().idle_summary_s, periods().jitter);
  }

  void add_wants() {
    std::vector<Source> sources;
    for (const auto& [origin, peer] : state_.peers.all()) {
      if (hears_us(peer, periods(), now_)) sources.push_back({origin, &peer.holds});
    }
    if (sources.empty()) return;
    for (auto& [peer, streams] :
         find_wants(state_.self(), state_.store, state_.assemblies, sources, state_.params.caps)) {
      out_.add(MessageKind::kWants,
               encode_wants({peer, state_.peers.find(peer)->newest, std::move(streams)}));
    }
    sender_.wants.done(now_, periods().want_s, periods().jitter);
  }

  [[nodiscard]] bool allows(std::size_t bytes) const {
    return sender_.budget.allows(copies() * (out_.bytes() + static_cast<double>(bytes)));
  }

  /// What was just made goes at once, once: a summary and a want take a second. What is lost is wanted.
  /// Nothing is pushed while nobody hears it, or while mates lack much.
  void push_own() {
    const bool heard = std::ranges::any_of(
        state_.peers.all(), [&](const auto& entry) { return hears_us(entry.second, periods(), now_); });
    for (const ItemKind kind : {ItemKind::kLog, ItemKind::kRelation, ItemKind::kKeyframe}) {
      const StreamKey key{kind, state_.self()};
      const ItemStream* stream = state_.store.stream(key);
      if (stream == nullptr) continue;
      std::uint32_t& next = sender_.pushed.at(static_cast<std::size_t>(kind));
      const auto newest = static_cast<std::uint32_t>(std::min<std::size_t>(
          stream->end(), heard && !sender_.catching_up ? state_.params.caps.pushed : 0));
      next = std::max(next, stream->end() - newest);
      while (next < stream->end() && push({key, next})) ++next;
    }
  }

  /// False when the budget does not allow all of it now.
  bool push(const ItemKey& key) {
    const ItemBytes item = state_.store.find(key);
    if (item == nullptr) return true;
    const bool whole = key.stream.kind != ItemKind::kKeyframe;
    const std::size_t pieces = whole ? 1 : pieces_of(item->size());
    for (std::uint8_t i = 0; i < pieces; ++i) {
      if (sender_.sent.find(key, i)) continue;
      const std::size_t size = whole ? item->size() : span_of(item->size(), i).size;
      if (!allows(size)) return false;
      const DuePiece piece{key, i, 0, 0, static_cast<std::uint32_t>(size)};
      if (whole)
        add_small(key.stream.kind == ItemKind::kLog ? MessageKind::kLog : MessageKind::kRelation, piece);
      else
        add_piece(piece, std::nullopt);
    }
    return true;
  }

  void add_items(Due due, std::span<const Peer* const> mates) {
    for (const DuePiece& piece : due.log) {
      if (allows(piece.size)) add_small(MessageKind::kLog, piece);
    }
    std::size_t next_relation = 0;
    PieceQueue pieces(std::move(due.keyframes), mates.size());
    while (allows(kDatagramBytesMax)) {
      const bool turn = pieces.empty() || sender_.picks % kRelationsEvery == kRelationsEvery - 1;
      if (turn) add_relations(due.relations, next_relation);
      if (pieces.empty()) break;
      const PieceQueue::Pick pick = pieces.take(sender_.picks++ % kNewestEvery == kNewestEvery - 1);
      add_piece(pick.piece, pick.partner);
      // What a piece leaves free takes a relation.
      while (next_relation < due.relations.size() && out_.fits(due.relations[next_relation].size + 20))
        add_small(MessageKind::kRelation, due.relations[next_relation++]);
    }
  }

  /// About a datagram of them.
  void add_relations(const std::vector<DuePiece>& relations, std::size_t& next) {
    const bool alone = next < relations.size();
    for (std::size_t bytes = 0;
         next < relations.size() && bytes < kBodyBytesMax && allows(relations[next].size); ++next) {
      bytes += relations[next].size + 20;
      add_small(MessageKind::kRelation, relations[next]);
    }
    if (alone) ++sender_.picks;
  }

  void add_small(MessageKind kind, const DuePiece& piece) {
    const std::uint32_t counter = out_.add(kind, item_body(piece.key, *state_.store.find(piece.key)));
    sender_.sent.note(piece.key, piece.index, counter);
  }

  void add_piece(const DuePiece& piece, const std::optional<DuePiece>& partner) {
    const ItemBytes item = state_.store.find(piece.key);
    const PieceHead head = head_of(piece.key, *item, piece.index);
    std::uint32_t counter = 0;
    if (partner) {
      const ItemBytes other = state_.store.find(partner->key);
      const PieceHead other_head = head_of(partner->key, *other, partner->index);
      counter = out_.add(MessageKind::kCoded, encode_coded(head, piece_of(*item, piece.index), other_head,
                                                           piece_of(*other, partner->index)));
      sender_.sent.note(partner->key, partner->index, counter);
    } else {
      ByteWriter body;
      write_piece_head(body, head);
      body.append(piece_of(*item, piece.index));
      counter = out_.add(MessageKind::kPiece, body.bytes());
    }
    sender_.sent.note(piece.key, piece.index, counter);
  }

  ExchangeState& state_;
  Sender& sender_;
  Outbox out_;
  types::Stamp now_;
};

}  // namespace

std::vector<Datagram> make_datagrams(ExchangeState& state, types::Stamp now) {
  state.peers.forget(state.params.periods, now);
  return Composer(state, now).compose();
}

}  // namespace topo::team

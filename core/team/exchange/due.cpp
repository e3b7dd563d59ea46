// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/due.hpp"

#include <algorithm>
#include <tuple>

#include "core/team/exchange/wire.hpp"

namespace topo::team {
namespace {

constexpr std::size_t kSentMax = 8'192;    // pieces: some 40 s of catching up
constexpr std::size_t kWantingMax = 32;    // bits of DuePiece::wanters
constexpr std::size_t kPartnersMax = 256;  // that are looked at: bounds the cost of one piece

/// Collects what one mate wants.
class Collection {
 public:
  Collection(const ItemStore& store, const SentLately& sent, std::size_t items_max)
      : store_(store), sent_(sent), items_max_(items_max) {}

  void add(const WantList& wants, std::uint32_t mate) {
    heard_ = wants.heard;
    mate_ = mate;
    std::size_t items = 0;
    for (const StreamWants& stream : wants.streams) {
      const ItemStream* held = store_.stream(stream.key);
      if (held == nullptr) continue;
      for (const WantRun& run : stream.runs) {
        for (auto at = held->items().lower_bound(run.first);
             at != held->items().end() && run.covers(at->first); ++at) {
          if (++items > items_max_) return;
          add_item({stream.key, at->first}, at->second->size(), run.pieces);
        }
      }
    }
  }

  [[nodiscard]] std::size_t wanted_bytes() const { return wanted_bytes_; }

  std::vector<DuePiece> take() {
    const auto key = [](const DuePiece& piece) { return std::tie(piece.key, piece.index); };
    std::sort(pieces_.begin(), pieces_.end(),
              [&](const DuePiece& a, const DuePiece& b) { return key(a) < key(b); });
    std::vector<DuePiece> merged;
    for (const DuePiece& piece : pieces_) {
      if (!merged.empty() && key(merged.back()) == key(piece))
        merged.back().wanters |= piece.wanters;
      else
        merged.push_back(piece);
    }
    return merged;
  }

 private:
  void add_item(const ItemKey& key, std::size_t bytes, PieceBits pieces) {
    const bool whole = key.stream.kind != ItemKind::kKeyframe;
    const std::size_t count = whole ? 1 : pieces_of(bytes);
    for (std::uint8_t i = 0; i < count; ++i) {
      if ((pieces >> i & 1U) == 0) continue;
      const std::size_t size = whole ? bytes : span_of(bytes, i).size;
      wanted_bytes_ += size;
      const auto sent = sent_.find(key, i);
      if (sent && is_later(*sent, heard_)) continue;
      pieces_.push_back({key, i, 1U << mate_, 0, static_cast<std::uint32_t>(size)});
    }
  }

  const ItemStore& store_;
  const SentLately& sent_;
  std::size_t items_max_;
  std::uint32_t heard_ = 0;
  std::uint32_t mate_ = 0;
  std::size_t wanted_bytes_ = 0;
  std::vector<DuePiece> pieces_;
};

/// The wants of a stream, null when it has none.
const StreamWants* wants_of(const Peer& mate, const StreamKey& key) {
  if (!mate.wants) return nullptr;
  const auto& streams = mate.wants->streams;
  const auto at = std::find_if(streams.begin(), streams.end(),
                               [&](const StreamWants& wants) { return wants.key == key; });
  return at == streams.end() ? nullptr : &*at;
}

/// The mates that hold a piece.
std::uint32_t holders_of(std::span<const Peer* const> mates, const DuePiece& piece) {
  std::uint32_t holders = 0;
  for (std::uint32_t i = 0; i < mates.size(); ++i) {
    if ((piece.wanters >> i & 1U) == 0 && holds_piece(*mates[i], piece.key, piece.index)) holders |= 1U << i;
  }
  return holders;
}

}  // namespace

void SentLately::note(const ItemKey& key, std::uint8_t index, std::uint32_t counter) {
  counters_[{key, index}] = counter;
  order_.push_back({{key, index}, counter});
  for (; order_.size() > kSentMax; order_.pop_front()) {
    const auto at = counters_.find(order_.front().first);
    if (at != counters_.end() && at->second == order_.front().second) counters_.erase(at);
  }
}

std::optional<std::uint32_t> SentLately::find(const ItemKey& key, std::uint8_t index) const {
  const auto at = counters_.find({key, index});
  return at == counters_.end() ? std::nullopt : std::optional(at->second);
}

std::vector<const Peer*> wanting(const Peers& peers, const slam::Origin& self, const PeriodParams& periods,
                                 types::Stamp now) {
  std::vector<const Peer*> mates;
  for (const auto& [origin, peer] : peers.all()) {
    const bool lately = now - peer.wanted <= types::from_seconds(periods.alive_s);
    if (mates.size() < kWantingMax && peer.wants && peer.wants->to == self && lately &&
        is_alive(peer, periods, now))
      mates.push_back(&peer);
  }
  return mates;
}

Due find_due(std::span<const Peer* const> mates, const ItemStore& store, const SentLately& sent,
             const CapParams& caps) {
  Collection collection(store, sent, caps.wanted_items);
  for (std::uint32_t i = 0; i < mates.size(); ++i) collection.add(*mates[i]->wants, i);
  Due due;
  due.wanted_bytes = collection.wanted_bytes();
  std::vector<DuePiece> pieces = collection.take();
  for (DuePiece& piece : pieces) {
    due.bytes += piece.size;
    const ItemKind kind = piece.key.stream.kind;
    if (kind == ItemKind::kKeyframe) piece.holders = holders_of(mates, piece);
    (kind == ItemKind::kLog        ? due.log
     : kind == ItemKind::kRelation ? due.relations
                                   : due.keyframes)
        .push_back(piece);
  }
  return due;
}

bool holds_piece(const Peer& mate, const ItemKey& key, std::uint8_t index) {
  if (const StreamWants* wants = wants_of(mate, key.stream)) {
    for (const WantRun& run : wants->runs) {
      if (run.covers(key.number)) return (run.pieces >> index & 1U) == 0;
    }
    if (key.number < wants->covered) return true;
  }
  const auto at = mate.holds.find(key.stream);
  return at != mate.holds.end() && at->second.holds(key.number);
}

PieceQueue::PieceQueue(std::vector<DuePiece> pieces, std::size_t mates)
    : pieces_(std::move(pieces)),
      all_(mates >= kWantingMax ? ~0U : (1U << mates) - 1U),
      end_(pieces_.size()) {}

bool PieceQueue::empty() const { return begin_ == end_ && deferred_.empty(); }

void PieceQueue::trim() {
  while (begin_ < end_ && pieces_[begin_].size == 0) ++begin_;
  while (begin_ < end_ && pieces_[end_ - 1].size == 0) --end_;
}

PieceQueue::Pick PieceQueue::take(bool newest) {
  while (begin_ < end_) {
    const std::size_t at = newest ? end_ - 1 : begin_;
    const DuePiece piece = pieces_[at];
    const auto partner = piece.wanters == all_ ? std::nullopt : partner_of(at);
    pieces_[at].size = 0;
    Pick pick{piece, std::nullopt};
    if (partner) {
      pick.partner = pieces_[*partner];
      pieces_[*partner].size = 0;
    }
    trim();
    if (partner || piece.wanters == all_) return pick;
    deferred_.push_back(piece);
  }
  const DuePiece piece = deferred_.front();
  deferred_.pop_front();
  return {piece, std::nullopt};
}

std::optional<std::size_t> PieceQueue::partner_of(std::size_t at) const {
  const DuePiece& piece = pieces_[at];
  std::size_t looked = 0;
  for (std::size_t i = begin_; i < end_ && looked < kPartnersMax; ++i, ++looked) {
    const DuePiece& other = pieces_[i];
    const bool apart = other.size > 0 && (other.wanters & piece.wanters) == 0;
    const bool known = (piece.wanters & ~other.holders) == 0 && (other.wanters & ~piece.holders) == 0;
    if (i != at && apart && known) return i;
  }
  return std::nullopt;
}

}  // namespace topo::team

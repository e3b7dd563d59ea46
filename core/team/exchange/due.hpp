// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "core/team/exchange/peers.hpp"

namespace topo::team {

/// A piece that is wanted from here; items that fit in one datagram have one piece.
struct DuePiece {
  ItemKey key;
  std::uint8_t index = 0;
  std::uint32_t wanters = 0;  ///< bit i: the i-th wanting mate
  std::uint32_t holders = 0;  ///< of a keyframe's: bit i: the i-th wanting mate holds it
  std::uint32_t size = 0;     ///< bytes
};

/// All that is due, each list in the order of the keys.
struct Due {
  std::vector<DuePiece> log, relations, keyframes;
  std::size_t bytes = 0;         ///< of these
  std::size_t wanted_bytes = 0;  ///< with what is under way
};

/// In which datagram a piece was last sent: what was sent after the datagram that a mate had heard when it
/// wrote its wants may still be under way. The newest few thousand: older ones have arrived, or are wanted
/// again.
class SentLately {
 public:
  void note(const ItemKey& key, std::uint8_t index, std::uint32_t counter);
  [[nodiscard]] std::optional<std::uint32_t> find(const ItemKey& key, std::uint8_t index) const;

 private:
  using Key = std::pair<ItemKey, std::uint8_t>;
  std::map<Key, std::uint32_t> counters_;
  std::deque<std::pair<Key, std::uint32_t>> order_;
};

/// Mates whose wants count: those that ask this robot, are alive and asked lately. At most 32.
[[nodiscard]] std::vector<const Peer*> wanting(const Peers& peers, const slam::Origin& self,
                                               const PeriodParams& periods, types::Stamp now);

/// What they want, is held, and is not under way to them.
[[nodiscard]] Due find_due(std::span<const Peer* const> mates, const ItemStore& store, const SentLately& sent,
                           const CapParams& caps);

/// True when a mate's newest wants, or its summary, say that it holds a piece of a keyframe.
[[nodiscard]] bool holds_piece(const Peer& mate, const ItemKey& key, std::uint8_t index);

/// The pieces of keyframes one after the other, oldest first, or newest: what all want, and two that are sent
/// as one because the mates that want one hold the other (coding.hpp). What only some mates want and has no
/// partner yet comes last: a partner may turn up.
class PieceQueue {
 public:
  PieceQueue(std::vector<DuePiece> pieces, std::size_t mates);
  [[nodiscard]] bool empty() const;
  struct Pick {
    DuePiece piece;
    std::optional<DuePiece> partner;
  };
  /// Precondition: not empty.
  Pick take(bool newest);

 private:
  void trim();
  [[nodiscard]] std::optional<std::size_t> partner_of(std::size_t at) const;

  std::vector<DuePiece> pieces_;  // size 0: taken, or deferred
  std::uint32_t all_;             // bits of the mates
  std::size_t begin_ = 0, end_;
  std::deque<DuePiece> deferred_;
};

}  // namespace topo::team

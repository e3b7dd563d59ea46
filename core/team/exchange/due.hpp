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
  std::uint32_t size = 0;     ///< bytes
};

/// All that is due, each list in the order of the keys.
struct Due {
  std::vector<DuePiece> log, relations, keyframes;
  std::size_t bytes = 0;
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

/// Of the other pieces of `due`, the first that together with `due[at]` helps all who want either: those who
/// want the one hold the other. Nothing when every mate wants `due[at]`, or none fits.
[[nodiscard]] std::optional<std::size_t> find_partner(std::span<const DuePiece> due, std::size_t at,
                                                      std::span<const Peer* const> mates);

}  // namespace topo::team

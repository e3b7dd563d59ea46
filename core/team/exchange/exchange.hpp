// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/slam/keyframe_set.hpp"
#include "core/slam/relation_set.hpp"
#include "core/team/exchange/item_store.hpp"
#include "core/team/exchange/news.hpp"
#include "core/team/exchange/params.hpp"

// The team's exchange (DESIGN "Team"): state and datagrams in, datagrams out. What a robot knows is a join of
// immutable items (item.hpp); each robot broadcasts what it holds and asks for what it lacks, so that nothing
// is ever marked as sent, no queue exists per mate, and each item reaches every robot over whatever links
// come up. Statuses are newest-wins. No I/O, no clock: time comes in as a value of this robot's clock and
// never decreases; no other robot's clock decides anything. Not thread-safe: it belongs to one thread, which
//
//   feeds   add_keyframe, add_relation, add_entry, say, order, acknowledge   what is made here
//           restore_*                                                        what a journal held
//           take(datagram, now)                                              what arrives
//   asks    datagrams(now)     every 20 to 50 ms: what to broadcast now
//           take_news(now)     a bounded part of what is new, for mapper and planner
namespace topo::team {

/// One datagram, at most kDatagramBytesMax, to all mates in reach; any of it may arrive twice, late or never.
using Datagram = std::vector<std::byte>;

class Exchange {
 public:
  Exchange(const ExchangeIdentity& identity, const ExchangeParams& params);
  ~Exchange();
  Exchange(const Exchange& other);
  Exchange& operator=(const Exchange& other);
  Exchange(Exchange&& other) noexcept;
  Exchange& operator=(Exchange&& other) noexcept;

  /// An own keyframe; its origin is this robot in this run, its sequence the number after the last. One that
  /// was added before changes nothing. kInvalidInput: another origin or number, or over kItemBytesMax.
  [[nodiscard]] types::Status add_keyframe(const slam::Keyframe& keyframe);
  /// The same for a relation found here (Mapper::found_since).
  [[nodiscard]] types::Status add_relation(const slam::FoundRelation& found);
  /// Appends an entry to this run's log. kInvalidInput: places not finite, or a polygon out of bounds.
  [[nodiscard]] types::Result<EntryId> add_entry(const LogBody& body);

  /// Items of any origin and run from a journal, in any order: they are held and offered to mates, and are no
  /// news. Before the first add_*, take and datagrams. Numbering of this run continues after what is restored
  /// of it.
  [[nodiscard]] types::Status restore_keyframe(const slam::Keyframe& keyframe);
  [[nodiscard]] types::Status restore_relation(const slam::FoundRelation& found);
  [[nodiscard]] types::Status restore_entry(const LogEntry& entry);

  /// The robot's status: the newest replaces the one before and is sent from now on. Its `robot` and
  /// `sequence` are set here; `visited` and `looked` become entries of the log where they differ from it. As
  /// many bids and points of the way as fit in one datagram are sent, places rounded to centimetres; claim,
  /// pose and start exactly.
  void say(const StatusMessage& status);

  /// Gives an order to the whole team or to one mate: an entry of the log, and repeated before everything
  /// else until all mates that are alive and that it is for have said their word. It does not appear in this
  /// robot's own news.
  [[nodiscard]] EntryId order(const Order& order, types::Stamp now);
  /// This robot has carried out an order, or refuses it with a reason: the giver learns of it. To be called
  /// when the wheels' thread has it. Of the reason what is printable and fits is kept.
  void acknowledge(const EntryId& order, types::Stamp now, std::string_view refused = {});
  /// Robots that have acknowledged an order, by id, whatever way their word took, and those that refuse it.
  [[nodiscard]] std::vector<std::uint16_t> acknowledged_by(const EntryId& order) const;
  [[nodiscard]] std::map<std::uint16_t, std::string> refused_by(const EntryId& order) const;

  /// Takes one datagram as it arrived. Everything in it is checked; what is wrong is dropped and counted.
  /// `sender`: the robot that the carrier has it from, by more than the sender's word; nothing: by its word.
  void take(std::span<const std::byte> datagram, types::Stamp now,
            std::optional<std::uint16_t> sender = std::nullopt);

  /// What to broadcast now, most urgent first, within the budget. Empty when nothing is due.
  [[nodiscard]] std::vector<Datagram> datagrams(types::Stamp now);

  /// What is new since the last call, keyframes and relations at most as many as CapParams says; the rest
  /// waits, and without `room` all of them do: orders and statuses wait for no mapper.
  [[nodiscard]] ExchangeNews take_news(types::Stamp now, bool room = true);

  /// Mates in the order of their ids, those heard within `forget_s`.
  [[nodiscard]] std::vector<PeerView> peers(types::Stamp now) const;
  [[nodiscard]] const ExchangeCounters& counters() const;
  [[nodiscard]] const ExchangeIdentity& identity() const;
  /// All that is held, and the hash over it: equal hashes are equal sets.
  [[nodiscard]] const ItemStore& items() const;
  /// Bytes of incomplete items; bounded by CapParams::assembly_bytes.
  [[nodiscard]] std::size_t assembly_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The sets from which a canonical map is built (slam::canonical_map).
[[nodiscard]] slam::KeyframeSet keyframes_of(const ItemStore& items);
[[nodiscard]] slam::RelationLog relations_of(const ItemStore& items);
/// The log of all robots in the order of the keys.
[[nodiscard]] std::vector<LogEntry> log_of(const ItemStore& items);

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/relation_set.hpp"
#include "core/team/exchange/log_entry.hpp"
#include "core/team/status_message.hpp"
#include "core/types/stamp.hpp"

// What comes out of the exchange beside datagrams.
namespace topo::team {

/// The newest status of a mate, in the map frame of that mate's (robot, run): see in_frame(). `visited` and
/// `looked` are what the log holds of that run.
struct HeardStatus {
  StatusMessage message;
  std::uint32_t run = 0;
  types::Stamp heard{};  ///< by the clock of this robot
};

/// An operator's order that is new here.
struct HeardOrder {
  EntryId id;
  Order order;
  /// How long ago it was given, as the sum of the times that each robot on its way held it; empty when it
  /// came with the log and not as an order that is being repeated: then it is old.
  std::optional<types::Duration> age;
};

/// Another live robot has an id that must be unique: this robot's (`own`), or that of two mates. Until an
/// operator changes it, nothing of what they send can be told apart.
struct DuplicateId {
  std::uint16_t robot = 0;
  std::uint32_t run_a = 0, run_b = 0;
  bool own = false;
};

/// What came since the last call. Each keyframe, relation and entry comes once; of statuses the newest of
/// each mate that said something. An order that came with the log first comes once more when it is heard as a
/// repeated one.
struct ExchangeNews {
  std::vector<slam::KeyframePtr> keyframes;
  std::vector<slam::FoundRelation> relations;  ///< check_relation() holds
  std::vector<LogEntry> entries;               ///< of mates and of this robot, for the journal
  std::vector<HeardOrder> orders;              ///< of mates
  std::vector<HeardStatus> statuses;
  std::vector<DuplicateId> duplicates;  ///< while it lasts, once in `alive_s` each
  [[nodiscard]] bool empty() const {
    return keyframes.empty() && relations.empty() && entries.empty() && orders.empty() && statuses.empty() &&
           duplicates.empty();
  }
};

/// A mate as seen from here, for display; no decision uses it.
struct PeerView {
  std::uint16_t robot = 0;
  std::uint32_t run = 0;
  types::Stamp heard{};  ///< the last datagram
  bool alive = false;    ///< heard within `alive_s`
  bool hears_us = false;
  bool same_sets = false;  ///< equal hashes over all items at its last summary
  std::optional<double> round_trip_s;
  std::optional<double> loss_in, loss_out;  ///< shares of the datagrams from it, and of this robot's to it
  std::optional<double> clock_offset_s;     ///< its clock less this one's, by the round trip
  std::size_t it_lacks_items = 0, it_lacks_bytes = 0;      ///< of what is held here
  std::size_t lacks_here_items = 0, lacks_here_bytes = 0;  ///< of what it says it holds; bytes are estimated
};

/// What datagrams are made of, for counting.
enum class MessageKind : std::uint8_t {
  kPresence,
  kStatus,
  kSummary,
  kWants,
  kOrder,
  kLog,
  kRelation,
  kPiece,
  kCoded
};
inline constexpr std::size_t kMessageKinds = 9;
std::string_view to_text(MessageKind kind);

/// Counted since the beginning.
struct ExchangeCounters {
  std::uint64_t sent = 0, sent_bytes = 0;                    ///< datagrams
  std::array<std::uint64_t, kMessageKinds> sent_bytes_of{};  ///< by kind, without the heads of the datagrams
  std::uint64_t received = 0, received_bytes = 0;
  std::uint64_t own_echo = 0;        ///< this robot's own datagrams, by way of multicast
  std::uint64_t other_version = 0;   ///< dropped
  std::uint64_t other_team = 0;      ///< dropped
  std::uint64_t false_number = 0;    ///< from another robot than they say; dropped
  std::uint64_t malformed = 0;       ///< datagrams of which something was dropped
  std::uint64_t malformed_item = 0;  ///< complete items that do not decode to what their key says; dropped
  std::uint64_t replayed = 0;        ///< statuses, summaries and wants older than one that was taken; dropped
  std::uint64_t too_many = 0;        ///< beyond a bound of CapParams; dropped
  std::uint64_t claims_ours = 0;     ///< items of this very run that this robot never made; dropped
  std::uint64_t contradicting = 0;   ///< items under a key that is held with other bytes
  std::uint64_t repeated = 0;        ///< pieces and items that were held already
  std::uint64_t duplicate_ids = 0;   ///< datagrams from a robot whose id another live one has; dropped
};

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "core/team/exchange/due.hpp"
#include "core/team/exchange/exchange.hpp"
#include "core/team/exchange/orders.hpp"

// The state of the exchange, and the steps over it: intake.cpp writes what arrives, sending.cpp makes
// datagrams.
namespace topo::team {

/// Keys of what is new and was not handed out: the items themselves are in the store.
struct Unread {
  std::deque<ItemKey> keyframes, relations, entries;
  std::vector<HeardOrder> orders;
  bool same_run_heard = false;  ///< another robot speaks with this one's id and run
  types::Stamp duplicates_told{};
};

/// What sending remembers from one call to the next.
struct Sender {
  explicit Sender(const PeriodParams& periods)
      : presence(periods.seed ^ 1U),
        status(periods.seed ^ 2U),
        summary(periods.seed ^ 3U),
        wants(periods.seed ^ 4U) {}
  ByteBudget budget;
  bool catching_up = false;
  Periodic presence, status, summary, wants;
  std::uint32_t counter = 0;  ///< of the next datagram
  SentLately sent;
  std::optional<StatusMessage> said;          ///< to be sent
  std::uint64_t statuses = 0;                 ///< said so far
  std::optional<std::uint64_t> summary_hash;  ///< of the store at the last summary
  types::Stamp summarised{};
  std::uint64_t picks = 0;  ///< pieces chosen so far
  /// By kind, the own item that is the next to go before anybody asks.
  std::array<std::uint32_t, kItemKinds> pushed{};
};

struct ExchangeState {
  ExchangeState(const ExchangeIdentity& who, const ExchangeParams& how)
      : identity(who),
        params(how),
        assemblies(how.caps.assembly_bytes),
        orders(how.periods.seed),
        sender(how.periods) {}
  [[nodiscard]] slam::Origin self() const { return {identity.robot, identity.run}; }

  ExchangeIdentity identity;
  ExchangeParams params;
  ItemStore store;
  Assemblies assemblies;
  Peers peers;
  Orders orders;
  Sender sender;
  Unread unread;
  ExchangeCounters counters;
};

struct Exchange::State : ExchangeState {
  using ExchangeState::ExchangeState;
};

/// Puts a checked item into the store and notes what it says about orders.
Stored store_item(ExchangeState& state, const ItemKey& key, std::vector<std::byte> bytes);

/// Exchange::take.
void take_datagram(ExchangeState& state, std::span<const std::byte> datagram, types::Stamp now,
                   std::optional<std::uint16_t> sender);

/// Exchange::datagrams.
[[nodiscard]] std::vector<Datagram> make_datagrams(ExchangeState& state, types::Stamp now);

/// Exchange::peers.
[[nodiscard]] std::vector<PeerView> views_of(const ExchangeState& state, types::Stamp now);

/// What a run's log says of places: its visited goals and the openings that it looked into.
struct LogPlaces {
  std::vector<types::Vector2> visited, looked;
};
[[nodiscard]] LogPlaces places_of(const ItemStore& store, const slam::Origin& origin);
/// The entries that lead from `before` to what a status says.
[[nodiscard]] std::vector<LogBody> changes(const LogPlaces& before, const StatusMessage& status);

}  // namespace topo::team

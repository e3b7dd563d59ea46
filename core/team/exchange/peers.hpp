// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bitset>
#include <map>
#include <optional>
#include <vector>

#include "core/team/exchange/link_estimate.hpp"
#include "core/team/exchange/news.hpp"
#include "core/team/exchange/params.hpp"
#include "core/team/exchange/wants.hpp"

namespace topo::team {

/// One run of a mate, as last heard.
struct Peer {
  types::Stamp first{}, heard{};
  std::uint32_t newest = 0;  ///< counter of its datagrams
  std::bitset<1024> window;  ///< bit i: datagram newest - i came
  LinkEstimate link;
  std::optional<std::uint32_t> summary_at, wants_at, status_at, presence_at;  ///< counters of the newest ones
  std::map<StreamKey, StreamSummary> holds;
  std::optional<std::uint64_t> hash;  ///< over all that it holds
  std::optional<WantList> wants;
  types::Stamp wanted{};  ///< when they came
  std::optional<StatusMessage> status;
  types::Stamp said{};  ///< when it came
  bool status_is_new = false;
  std::optional<types::Stamp> heard_us;  ///< when it last said so
};

/// Whether a datagram may be looked at.
enum class Hearing : std::uint8_t {
  kFresh,
  kRepeated,  ///< it came before, or is too old to tell
  kTooMany,   ///< there are as many mates as the cap allows
};

/// The mates by robot and run. An entry a run: a restart is another one, and the old one falls silent.
class Peers {
 public:
  using Map = std::map<slam::Origin, Peer>;

  Hearing hear(const slam::Origin& sender, std::uint32_t counter, const ExchangeParams& params,
               types::Stamp now);
  /// Null when it was not heard.
  [[nodiscard]] Peer* find(const slam::Origin& origin);
  [[nodiscard]] Map& all() { return peers_; }
  [[nodiscard]] const Map& all() const { return peers_; }
  /// Drops those that were not heard for `forget_s`.
  void forget(const PeriodParams& periods, types::Stamp now);
  /// True when two runs of a robot are both heard now: what they say cannot be told apart.
  [[nodiscard]] bool is_double(std::uint16_t robot, const slam::Origin& self, const PeriodParams& periods,
                               types::Stamp now) const;
  /// Robots of which two runs are both heard; `self` is heard all the time.
  [[nodiscard]] std::vector<DuplicateId> duplicates(const slam::Origin& self, const PeriodParams& periods,
                                                    types::Stamp now) const;
  /// Of each mate that is not forgotten the run that was heard last, and both of two runs that are
  /// duplicates. An earlier run is over: its items stay, and it speaks no more.
  [[nodiscard]] std::vector<slam::Origin> listed(const slam::Origin& self, const PeriodParams& periods,
                                                 types::Stamp now) const;

 private:
  Map peers_;
};

[[nodiscard]] bool is_alive(const Peer& peer, const PeriodParams& periods, types::Stamp now);
/// True when it is alive and said lately that it hears this robot.
[[nodiscard]] bool hears_us(const Peer& peer, const PeriodParams& periods, types::Stamp now);
/// Whether a message in datagram `counter` is newer than the newest one of its kind, which it then becomes.
[[nodiscard]] bool is_newer(std::optional<std::uint32_t>& newest, std::uint32_t counter);

}  // namespace topo::team

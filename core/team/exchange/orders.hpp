// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/team/exchange/budget.hpp"
#include "core/team/exchange/news.hpp"
#include "core/team/exchange/params.hpp"

namespace topo::team {

/// An order that is repeated from here.
struct UrgentOrder {
  EntryId id;
  types::Stamp since{};   ///< when it came to this robot
  types::Duration age{};  ///< that it had then
  Periodic next;
  std::optional<std::uint16_t> to = std::nullopt;  ///< whose word is awaited; nothing: that of all
};

/// The operator's orders: who has acknowledged which, and which are repeated. Every robot that holds a young
/// order repeats it until all mates that it hears and that it is for have acknowledged or refused it: so it
/// gets through a robot in between.
class Orders {
 public:
  explicit Orders(std::uint64_t seed) : seed_(seed) {}

  /// An order that came, or was given here, at that age. False when it is repeated already.
  bool repeat(const EntryId& id, types::Duration age, types::Stamp now,
              std::optional<std::uint16_t> to = std::nullopt);
  /// Drops those that have been repeated for as long as is allowed.
  void expire(const PeriodParams& periods, types::Stamp now);
  [[nodiscard]] std::vector<UrgentOrder>& urgent() { return urgent_; }
  [[nodiscard]] bool is_urgent(const EntryId& id) const;

  /// An acknowledgement, own or of a mate, that is held as `entry`.
  void note(const Acknowledgement& body, const EntryId& entry);
  /// True for a refusal too: the robot has said its word.
  [[nodiscard]] bool has_acknowledged(std::uint16_t robot, const EntryId& order) const;
  /// The robots that have carried it out, and those that refuse it, with the reason.
  [[nodiscard]] std::vector<std::uint16_t> acknowledged_by(const EntryId& order) const;
  [[nodiscard]] std::map<std::uint16_t, std::string> refused_by(const EntryId& order) const;

  /// A robot's acknowledgement is sent with the next datagrams, before what is wanted.
  void send_acknowledgement(std::uint16_t robot, const EntryId& order);
  [[nodiscard]] std::set<EntryId> take_to_send() { return std::exchange(to_send_, {}); }

 private:
  std::uint64_t seed_;
  std::vector<UrgentOrder> urgent_;
  struct Word {
    EntryId entry;
    std::string refused;  ///< empty: carried out
  };
  std::map<EntryId, std::map<std::uint16_t, Word>> acknowledged_;  ///< by order and robot
  std::set<EntryId> to_send_;
};

}  // namespace topo::team

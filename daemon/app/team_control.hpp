// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "daemon/app/doctor.hpp"
#include "daemon/config/configuration.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/threads/team_hand_over.hpp"

namespace topo::daemon {

/// Whether the link dropped something of a kind lately. A value.
class RecentDrops {
 public:
  RecentDrops(LinkDrop kind, types::Duration lately) : kind_(kind), lately_(lately) {}
  /// What the link tells of itself, now; its counts begin anew with its process.
  void note(const LinkStats& link, types::Stamp now);
  /// Forgets what is long ago.
  void tick(types::Stamp now);
  /// Since the first of those lately; 0: none lately.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  LinkDrop kind_;
  types::Duration lately_;
  std::uint64_t seen_ = 0, count_ = 0;
  types::Stamp last_{};
};

/// The team on main: orders to it and from it, and what is shown of it. Main only.
class TeamControl {
 public:
  /// `obey`: carries out an order of a mate's operator on this robot, or says why not.
  using Obey = std::function<types::Status(team::OrderKind kind, std::uint16_t from)>;
  TeamControl(const TeamConfig& configuration, TeamHandOver& team, Obey obey)
      : configuration_(configuration), team_(team), obey_(std::move(obey)) {}

  /// Sends an order to the whole team; this robot carries it out itself. Returns its number, by which json()
  /// names those who have acknowledged it; 0: there is no team, or no room for another order now.
  std::uint64_t order(team::OrderKind kind) { return send({kind}); }
  /// Sends an order to one mate. Refused when there is no team, or the mate is out of reach.
  types::Result<std::uint64_t> order_one(team::OrderKind kind, std::uint16_t robot, types::Stamp now);
  /// True for the number of this robot.
  [[nodiscard]] bool is_this(std::uint16_t robot) const {
    return configuration_.present && robot == configuration_.id;
  }

  /// This robot was halted, by its own operator or by order: what was given before does not set it in motion.
  void note_halt(types::Stamp now) { halted_ = now; }

  /// When fd() is readable.
  void collect();
  [[nodiscard]] int fd() const { return team_.orders_here.fd(); }

  /// Every tick.
  void tick(types::Stamp now);

  /// {"present": false}, or what `topoctl team` shows; times in seconds.
  [[nodiscard]] Json json(types::Stamp now) const;
  /// What is wrong with the team; empty: nothing.
  [[nodiscard]] std::string trouble() const;
  /// What the operator should know although nothing is wrong with this robot; empty: nothing.
  [[nodiscard]] std::string warning() const;
  /// Why no mission may begin; empty: the team is no reason.
  [[nodiscard]] std::string obstacle() const;
  /// For the doctor; nothing without a team.
  [[nodiscard]] std::optional<DoctorFacts::Team> facts() const;
  /// What the team's log says of areas.
  [[nodiscard]] const TeamAreas& areas() const { return report_.areas; }
  /// One line for the status.
  [[nodiscard]] Json brief() const;

 private:
  std::uint64_t send(const team::Order& order);
  /// Why an order of a mate is not to be obeyed although this robot could; empty: it is.
  [[nodiscard]] std::string outdated(const team::HeardOrder& heard) const;
  [[nodiscard]] Json order_json() const;

  const TeamConfig& configuration_;
  TeamHandOver& team_;
  Obey obey_;
  std::uint64_t orders_ = 0;
  std::map<slam::Origin, std::uint32_t> newest_heard_;  ///< number of each giver's newest order
  types::Stamp halted_{};                               ///< the last time
  TeamReport report_;
  RecentDrops own_number_{LinkDrop::kOwnNumber, std::chrono::seconds(5)};
  RecentDrops not_trusted_{LinkDrop::kNotTrusted, std::chrono::minutes(1)};
};

}  // namespace topo::daemon

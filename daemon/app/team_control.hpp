// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "daemon/config/configuration.hpp"
#include "daemon/control/json_rpc.hpp"
#include "daemon/threads/team_hand_over.hpp"

namespace topo::daemon {

/// The team on main: orders to it and from it, and what is shown of it. Main only.
class TeamControl {
 public:
  /// `obey`: carries out an order of a mate's operator on this robot.
  using Obey = std::function<void(team::OrderKind kind, std::uint16_t from)>;
  TeamControl(const TeamConfig& configuration, TeamHandOver& team, Obey obey)
      : configuration_(configuration), team_(team), obey_(std::move(obey)) {}

  /// Sends an order to the whole team; this robot carries it out itself. Returns its number, by which json()
  /// names those who have acknowledged it; 0: there is no team, or no room for another order now.
  std::uint64_t order(team::OrderKind kind);

  /// When fd() is readable.
  void collect();
  [[nodiscard]] int fd() const { return team_.orders_here.fd(); }

  /// Every tick.
  void tick();

  /// {"present": false}, or what `topoctl team` shows; times in seconds.
  [[nodiscard]] Json json(types::Stamp now) const;
  /// What is wrong with the team; empty: nothing.
  [[nodiscard]] std::string trouble() const;
  /// One line for the status.
  [[nodiscard]] Json brief() const;

 private:
  const TeamConfig& configuration_;
  TeamHandOver& team_;
  Obey obey_;
  std::uint64_t orders_ = 0;
  TeamReport report_;
};

}  // namespace topo::daemon

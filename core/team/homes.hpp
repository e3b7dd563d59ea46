// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "core/team/status_message.hpp"

namespace topo::team {

/// A start and the robot that entered there; it moves with the map, as that robot reports.
struct Home {
  std::uint16_t robot = 0;
  types::Vector2 p_map{0.0, 0.0};
  /// The team-mate that was bound for this start and gets this robot's old one instead: that team-mate's
  /// claim on it does not count.
  std::optional<std::uint16_t> from{};
  friend bool operator==(const Home&, const Home&) = default;
};

/// Selects the start to which a robot returns. Robots that entered at one spot may not be able to pass each
/// other there, so a start does not belong to the robot that entered there: the first robot to return takes
/// the innermost one (greatest `cost_m` of getting there; HUGE_VAL: no route), which no other robot has to
/// pass later. A start is taken when a team-mate stands there, or has it as its home and has the lower id or
/// is there; a start at which the robot itself stands is never taken. `present` is kept while it is free, at
/// its position as last reported by its owner. Empty: all are taken or out of reach. The order of team-mates
/// does not matter.
///
/// `passing`, if not null, is a team-mate whose route this robot, at home, blocks: the robot moves on to that
/// team-mate's home, and the team-mate then finds this robot's start free. Where no robot can pass another,
/// all move up. `at_start_m`: RosterParams.
std::optional<Home> choose_home(const StatusMessage& self, std::span<const StatusMessage* const> mates,
                                const std::optional<Home>& present, const StatusMessage* passing,
                                const std::function<double(const types::Vector2&)>& cost_m,
                                double at_start_m);

/// The nearest start, the robot's own or a team-mate's, if the robot stands there.
std::optional<Home> start_beside(const StatusMessage& self, std::span<const StatusMessage* const> mates,
                                 double at_start_m);

/// True when the robot stands at its home.
bool is_at_home(const StatusMessage& self, const Home& home, double at_start_m);

}  // namespace topo::team

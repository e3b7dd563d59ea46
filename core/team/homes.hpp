// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "core/team/status_message.hpp"

namespace topo::team {

/// A start, and whose it is: it moves with the map, as its owner says.
struct Home {
  std::uint16_t robot = 0;
  types::Vector2 p_map{0.0, 0.0};
  /// The mate that was bound for it, and gets what this robot had: what that mate says of it does not count.
  std::optional<std::uint16_t> from{};
  friend bool operator==(const Home&, const Home&) = default;
};

/// Where a robot comes home to. Robots that entered at one spot may not get past each other there, so that
/// their starts are anybody's: who comes first takes the one that is farthest in, by `cost_m` of getting
/// there (HUGE_VAL: no way), and nobody has to pass it later. A start is taken when a mate stands there, or
/// comes home to it and has the lower id or is there; never one on which the robot itself is. `present` is
/// kept while it is free, where its owner, if heard, says that it is now. Nothing: all are taken or out of
/// reach. The order of mates does not matter.
///
/// `passing`, if not null, is a mate that this robot, at home, stands in the way of: the robot goes on to
/// where that mate is bound for, which then finds its own free. Where nobody can pass another all move up.
std::optional<Home> choose_home(const StatusMessage& self, std::span<const StatusMessage* const> mates,
                                const std::optional<Home>& present, const StatusMessage* passing,
                                const std::function<double(const types::Vector2&)>& cost_m);

/// Is who stands here at home?
bool is_at_home(const StatusMessage& self, const Home& home);

}  // namespace topo::team

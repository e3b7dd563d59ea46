// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/pipeline/planning_step.hpp"
#include "core/slam/params.hpp"
#include "core/team/exchange/exchange.hpp"
#include "tests/bench/topobench/explore/map_source.hpp"

namespace topo::bench {

/// What connects a robot's parts with the team's exchange, as the daemon's thread for the team does: what
/// mapper and planner have goes in, what is new for them comes out. Knows where the mates are. Not
/// thread-safe.
class TeamNode {
 public:
  /// `source` is borrowed. `starts`: where the robots enter, in map; theirs is the id that is the index.
  /// Empty when nobody knows.
  TeamNode(std::uint16_t robot, SharedMapSource& source, const slam::MapperParams& mapping,
           std::vector<types::Se2> starts);

  /// Takes team-mates out of scans on their way to the mapper, by the pose of each scan in fidelity "plan",
  /// else by where dead reckoning has the robot.
  void mask_mates(Readings& readings);

  /// The messages that came since the last call. Good until the next one.
  pipeline::TeamInput heard();
  void say(const team::StatusMessage& message) { said_ = message; }

  void take(std::span<const std::byte> datagram, types::Stamp now) { exchange_.take(datagram, now); }
  /// Hands what is new to mapper and planner, what the robot has to the exchange, its message with where it
  /// is by now, and gives what is to be sent.
  std::vector<team::Datagram> exchange(types::Stamp now);

  /// The robot's own keyframes, by their numbers.
  [[nodiscard]] std::span<const slam::KeyframePtr> own_keyframes() const { return own_; }
  [[nodiscard]] const team::Exchange& state() const { return exchange_; }

 private:
  struct Place {
    types::Vector2 p_map{0.0, 0.0};
    types::Stamp heard{};
  };
  [[nodiscard]] std::vector<types::Vector2> mates_at(types::Stamp now) const;
  void take_news(types::Stamp now);
  void give_own();

  std::uint16_t robot_;
  SharedMapSource& source_;
  types::Se2 T_base_front_, T_base_coronal_;
  std::vector<types::Se2> starts_;
  team::Exchange exchange_;
  std::vector<slam::KeyframePtr> own_;
  std::map<std::uint16_t, Place> mates_;
  types::Transform2<types::Odom, types::Base> T_odom_base_;  ///< newest
  std::optional<team::StatusMessage> said_;
  std::vector<team::StatusMessage> inbox_, outbox_;  ///< messages that came, and those handed to the planner
};

}  // namespace topo::bench

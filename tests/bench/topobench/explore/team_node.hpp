// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/pipeline/planning_step.hpp"
#include "core/slam/params.hpp"
#include "core/team/exchange.hpp"
#include "tests/bench/topobench/explore/map_source.hpp"

namespace topo::bench {

using team::Letter;

/// A robot's end of the team's link: says what the planner says, keeps the others in keyframes and
/// relations (core/team/exchange.hpp), and knows where they are. Not thread-safe.
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

  /// Before letters are written: takes the robot's new keyframes into its set, and brings its message up to
  /// date with where it is by now.
  void gather();
  [[nodiscard]] Letter letter_to(std::uint16_t other) const;
  void take(std::uint16_t from, const Letter& letter, types::Stamp now);

  [[nodiscard]] const slam::KeyframeSet& keyframes() const { return exchange_.keyframes(); }
  [[nodiscard]] const slam::RelationLog& relations() const { return exchange_.relations(); }

 private:
  struct Place {
    types::Vector2 p_map{0.0, 0.0};
    types::Stamp heard{};
  };
  [[nodiscard]] std::vector<types::Vector2> mates_at(types::Stamp now) const;

  std::uint16_t robot_;
  SharedMapSource& source_;
  types::Se2 T_base_front_, T_base_coronal_;
  std::vector<types::Se2> starts_;
  team::Exchange exchange_;
  std::map<std::uint16_t, Place> mates_;
  types::Transform2<types::Odom, types::Base> T_odom_base_;  ///< newest
  std::optional<team::StatusMessage> said_;
  std::uint64_t messages_ = 0;
  std::vector<team::StatusMessage> inbox_, outbox_;  ///< messages that came, and those handed to the planner
};

}  // namespace topo::bench

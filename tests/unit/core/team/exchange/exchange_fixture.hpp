// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <random>
#include <vector>

#include "core/team/exchange/exchange.hpp"
#include "tests/unit/core/slam/keyframe_sample.hpp"
#include "tests/unit/core/team/clock.hpp"

// Robots that make keyframes and relations, and a radio between them.
namespace topo::team::testing {

inline const slam::Origin kSelf{1, 1};
inline const StreamKey kFrames{ItemKind::kKeyframe, kSelf};

inline std::vector<std::byte> bytes_of(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

inline ItemBytes item_of(std::initializer_list<int> values) {
  return std::make_shared<const std::vector<std::byte>>(bytes_of(values));
}

inline slam::Keyframe sample_keyframe(const slam::KeyframeId& id, std::size_t hits = 700) {
  std::mt19937 random(id.robot * 7'919U + id.sequence);
  slam::Keyframe keyframe = slam::testing::random_keyframe(id.sequence, hits, random);
  keyframe.id = id;
  return keyframe;
}

inline slam::FoundRelation odometry(const slam::KeyframeId& to) {
  slam::FoundRelation found;
  found.id = {to.robot, to.sequence - 1, to.run};
  found.key = {found.id, to};
  found.relation.T_from_to = {0.4, 0.01 * to.sequence, 0.001};
  found.relation.information(0, 1) = found.relation.information(1, 0) = 0.25;
  return found;
}

inline constexpr std::uint32_t kTeam = 0x1234;

inline ExchangeParams params_for(std::uint16_t robot) {
  ExchangeParams params;
  params.periods.seed = robot;
  return params;
}

/// An exchange that makes keyframe after keyframe.
struct Robot {
  explicit Robot(std::uint16_t id, std::uint32_t run = 1) : exchange({kTeam, id, run}, params_for(id)) {}
  Robot(const ExchangeIdentity& identity, const ExchangeParams& params) : exchange(identity, params) {}

  /// True when the exchange took the keyframe and its relation.
  bool make(std::size_t hits = 700) {
    const auto [team, robot, run] = exchange.identity();
    const slam::KeyframeId id{robot, made++, run};
    const bool added = exchange.add_keyframe(sample_keyframe(id, hits)).has_value();
    return added && (id.sequence == 0 || exchange.add_relation(odometry(id)).has_value());
  }

  Exchange exchange;
  std::uint32_t made = 0;
};

/// All that one sends now arrives at the other at once.
inline void send(Robot& from, Robot& to, types::Stamp now) {
  for (const Datagram& datagram : from.exchange.datagrams(now)) to.exchange.take(datagram, now);
}

/// Both send each other what they have for some seconds.
inline void talk(Robot& a, Robot& b, double from_s, double to_s) {
  for (double t = from_s; t < to_s; t += 0.05) {
    send(a, b, at(t));
    send(b, a, at(t));
  }
}

}  // namespace topo::team::testing

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/slam/keyframe_set.hpp"
#include "core/slam/relation_set.hpp"
#include "core/team/status_message.hpp"

// What robots of a team send each other: keyframes, relations and status messages. Pure: letters in, letters
// out.
namespace topo::team {

/// A keyframe, and where the sender's map has it.
struct PosedKeyframe {
  slam::KeyframePtr keyframe;
  types::Se2 T_map_base;
};

/// What a robot has seen and found, or heard of others.
struct News {
  std::vector<PosedKeyframe> keyframes;
  std::vector<slam::FoundRelation> relations;
  [[nodiscard]] bool empty() const { return keyframes.empty() && relations.empty(); }
};

/// What one robot sends another in one exchange; all of it may come twice, late or never.
struct Letter {
  std::optional<StatusMessage> message;
  std::vector<slam::OriginCount> keyframe_counts, relation_counts;  ///< what the sender has
  News news;  ///< what the receiver lacks, as far as the sender knows
};

struct ExchangeParams {
  std::size_t keyframes_in_letter = 20;
  std::size_t relations_in_letter = 60;  ///< some keyframes have two or three
};

/// Keeps the robots of a team in keyframes and relations. They go until the receiver's counts say that they
/// are there: what is lost is sent again, and one robot's reach a third by way of a second. A value.
class Exchange {
 public:
  explicit Exchange(const ExchangeParams& params = {}) : params_(params) {}

  /// The robot's own keyframes and relations.
  void add_own(const News& news);
  /// The pose of a keyframe in the robot's map; null when it is not in it.
  using PoseOf = std::function<const types::Se2*(const slam::KeyframeId& id)>;
  [[nodiscard]] Letter letter_to(std::uint16_t robot, const std::optional<StatusMessage>& message,
                                 const PoseOf& pose_of) const;
  /// Takes a letter in. Returns the part of its news that was not here.
  News take(std::uint16_t from, const Letter& letter);

  [[nodiscard]] const slam::KeyframeSet& keyframes() const { return keyframes_; }
  [[nodiscard]] const slam::RelationLog& relations() const { return relations_; }

 private:
  struct Counts {
    std::vector<slam::OriginCount> keyframes, relations;
  };

  ExchangeParams params_;
  slam::KeyframeSet keyframes_;
  slam::RelationLog relations_;
  std::map<std::uint16_t, Counts> there_;  // by robot, as last heard
};

/// A status message of one map's frame in another's.
StatusMessage in_frame(const types::Se2& T_map_mates, StatusMessage message);

}  // namespace topo::team

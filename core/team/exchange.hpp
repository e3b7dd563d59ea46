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

// What the robots of a team exchange: keyframes, relations and status messages. No I/O: letters in, letters
// out.
namespace topo::team {

/// A keyframe and its pose in the sender's map.
struct PosedKeyframe {
  slam::KeyframePtr keyframe;
  types::Se2 T_map_base;
};

/// Keyframes and relations of a robot, its own or received.
struct News {
  std::vector<PosedKeyframe> keyframes;
  std::vector<slam::FoundRelation> relations;
  [[nodiscard]] bool empty() const { return keyframes.empty() && relations.empty(); }
};

/// What one robot sends to another in one exchange; any of it may arrive twice, late or never.
struct Letter {
  std::optional<StatusMessage> message;
  std::vector<slam::OriginCount> keyframe_counts, relation_counts;  ///< what the sender has
  News news;  ///< what the receiver lacks, as far as the sender knows
};

struct ExchangeParams {
  std::size_t keyframes_in_letter = 20;
  std::size_t relations_in_letter = 60;  ///< some keyframes have two or three
};

/// Synchronises keyframes and relations between the robots of a team. An item is sent until the receiver's
/// counts include it: lost items are sent again, and items of one robot reach a third through a second. Value
/// semantics.
class Exchange {
 public:
  explicit Exchange(const ExchangeParams& params = {}) : params_(params) {}

  /// The robot's own keyframes and relations.
  void add_own(const News& news);
  /// The pose of a keyframe in the robot's map; null when the map does not contain it.
  using PoseOf = std::function<const types::Se2*(const slam::KeyframeId& id)>;
  [[nodiscard]] Letter letter_to(std::uint16_t robot, const std::optional<StatusMessage>& message,
                                 const PoseOf& pose_of) const;
  /// Accepts a letter. Returns the part of its news that was not stored here before.
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
  std::map<std::uint16_t, Counts> there_;  // by robot, as last received
};

/// A status message transformed from a team-mate's map frame into the robot's own.
StatusMessage in_frame(const types::Se2& T_map_mates, StatusMessage message);

}  // namespace topo::team

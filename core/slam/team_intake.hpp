// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "core/slam/alignment.hpp"
#include "core/slam/map_graph.hpp"
#include "core/slam/unplaced.hpp"

namespace topo::slam {

/// What became of keyframes and relations that were joined.
struct JoinVerdict {
  int placed = 0;  ///< keyframes of team-mates that entered the map
  int tied = 0;    ///< relations that entered the graph
  JoinVerdict& operator+=(const JoinVerdict& other) {
    placed += other.placed;
    tied += other.tied;
    return *this;
  }
};

/// Takes team-mates' keyframes and relations into the graph, in any order and with any repetition. A keyframe
/// enters the graph when a relation ties it to a node of the graph; the others wait here.
class TeamIntake {
 public:
  JoinVerdict join(std::span<const KeyframePtr> keyframes, std::span<const FoundRelation> relations,
                   MapGraph& graph);

  /// True for relations that were joined before.
  [[nodiscard]] bool knows(const RelationKey& key) const { return joined_.contains(key); }

  /// The oldest node that came since and that nothing ties to the own path; each is returned once.
  std::optional<std::size_t> take_untied(const MapGraph& graph);
  /// True while take_untied() has nodes to test.
  [[nodiscard]] bool has_new() const { return !unasked_.empty(); }

  /// The map of a team-mate that nothing ties to this one, when enough of it waits here, and again when both
  /// have grown.
  std::optional<AlignmentQuery> take_alignment_query(const MapGraph& graph, const MapperParams& params);

 private:
  struct Joining;
  Unplaced unplaced_;
  std::set<RelationKey> joined_;
  std::deque<std::size_t> unasked_;           ///< nodes of team-mates
  std::map<Origin, std::size_t> aligned_at_;  ///< keyframes, own and theirs, at the last query about them
};

}  // namespace topo::slam

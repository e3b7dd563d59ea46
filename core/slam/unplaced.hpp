// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "core/slam/relation_set.hpp"
#include "core/slam/session.hpp"

namespace topo::slam {

/// Data of team-mates that nothing connects to the map yet: keyframes, and relations with an end that is not
/// in the map.
class Unplaced {
 public:
  void add(const KeyframePtr& keyframe) { keyframes_.try_emplace(keyframe->id, keyframe); }
  void add(const FoundRelation& found);
  /// As MapGraph::keep_lower().
  void keep_lower(const FoundRelation& found);

  [[nodiscard]] bool contains(const KeyframeId& id) const { return keyframes_.contains(id); }
  [[nodiscard]] const FoundRelation* find(const RelationKey& key) const;
  /// Keys of the relations that have the keyframe at one end.
  [[nodiscard]] const std::vector<RelationKey>& at(const KeyframeId& id) const;
  [[nodiscard]] const std::map<KeyframeId, KeyframePtr>& keyframes() const { return keyframes_; }
  /// The keyframes here that are connected to a keyframe, as a separate map.
  [[nodiscard]] Session tied_to(const KeyframeId& origin, const GraphParams& graph) const;

  /// Removes what enters the map. Precondition of take(): the keyframe is here.
  KeyframePtr take(const KeyframeId& id);
  void erase(const RelationKey& key);

 private:
  void forget(const KeyframeId& end, const RelationKey& key);
  std::map<KeyframeId, KeyframePtr> keyframes_;
  std::map<RelationKey, FoundRelation> relations_;
  std::map<KeyframeId, std::vector<RelationKey>> by_end_;
};

}  // namespace topo::slam

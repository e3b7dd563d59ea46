// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/unplaced.hpp"

#include "core/slam/canonical_map.hpp"

namespace topo::slam {

void Unplaced::add(const FoundRelation& found) {
  if (!relations_.try_emplace(found.key, found).second) return;
  by_end_[found.key.first].push_back(found.key);
  by_end_[found.key.second].push_back(found.key);
}

void Unplaced::keep_lower(const FoundRelation& found) {
  const auto at = relations_.find(found.key);
  if (at != relations_.end() && is_lower(found.relation, at->second.relation)) at->second = found;
}

const FoundRelation* Unplaced::find(const RelationKey& key) const {
  const auto at = relations_.find(key);
  return at == relations_.end() ? nullptr : &at->second;
}

const std::vector<RelationKey>& Unplaced::at(const KeyframeId& id) const {
  static const std::vector<RelationKey> kNothing;
  const auto at = by_end_.find(id);
  return at == by_end_.end() ? kNothing : at->second;
}

Session Unplaced::tied_to(const KeyframeId& origin, const GraphParams& graph) const {
  KeyframeSet keyframes;
  RelationSet relations;
  for (const auto& [id, keyframe] : keyframes_) keyframes.insert(keyframe);
  for (const auto& [key, found] : relations_) relations.insert(key, found.relation);
  return canonical_session(keyframes, relations, origin, graph);
}

KeyframePtr Unplaced::take(const KeyframeId& id) { return keyframes_.extract(id).mapped(); }

void Unplaced::erase(const RelationKey& key) {
  relations_.erase(key);
  forget(key.first, key);
  forget(key.second, key);
}

void Unplaced::forget(const KeyframeId& end, const RelationKey& key) {
  const auto at = by_end_.find(end);
  if (at == by_end_.end()) return;
  std::erase(at->second, key);
  if (at->second.empty()) by_end_.erase(at);
}

}  // namespace topo::slam

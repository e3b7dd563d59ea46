// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/team_intake.hpp"

#include <utility>
#include <vector>

namespace topo::slam {

/// One call of join(): relations that may enter the graph now, odometry before closures, because the first
/// relation that reaches a keyframe gives its pose.
struct TeamIntake::Joining {
  TeamIntake& intake;
  MapGraph& graph;
  std::set<std::pair<bool, RelationKey>> open{};
  JoinVerdict verdict{};

  void consider(const RelationKey& key) {
    if (const FoundRelation* found = intake.unplaced_.find(key)) open.emplace(found->relation.robust, key);
  }
  void consider_all_at(const KeyframeId& id) {
    for (const RelationKey& key : intake.unplaced_.at(id)) consider(key);
  }

  void run() {
    while (!open.empty()) {
      const RelationKey key = open.begin()->second;
      open.erase(open.begin());
      settle(key);
    }
  }

  void settle(const RelationKey& key) {
    const FoundRelation* waiting = intake.unplaced_.find(key);
    if (waiting == nullptr) return;
    const auto [finder, ends, relation] = *waiting;
    auto from = graph.node_of(key.first), to = graph.node_of(key.second);
    if (!from && !to) return;
    if (!to) to = place(key.second, graph.poses()[*from] * relation.T_from_to);
    if (!from) from = place(key.first, graph.poses()[*to] * relation.T_from_to.inverse());
    if (!from || !to) return;
    intake.unplaced_.erase(key);
    graph.add({*from, *to, relation.T_from_to, relation.information, relation.robust, finder});
    ++verdict.tied;
  }

  std::optional<std::size_t> place(const KeyframeId& id, const types::Se2& pose) {
    if (!intake.unplaced_.contains(id)) return std::nullopt;
    const std::size_t node = graph.add_mates(intake.unplaced_.take(id), pose);
    intake.unasked_.push_back(node);
    ++verdict.placed;
    consider_all_at(id);
    return node;
  }
};

JoinVerdict TeamIntake::join(std::span<const KeyframePtr> keyframes, std::span<const FoundRelation> relations,
                             MapGraph& graph) {
  Joining joining{*this, graph};
  for (const FoundRelation& found : relations) {
    if (graph.has(found.key))
      graph.keep_lower(found);
    else if (joined_.insert(found.key).second)
      unplaced_.add(found);
    else
      unplaced_.keep_lower(found);
    joining.consider(found.key);
  }
  for (const KeyframePtr& keyframe : keyframes) {
    if (graph.node_of(keyframe->id)) continue;
    unplaced_.add(keyframe);
    joining.consider_all_at(keyframe->id);
  }
  joining.run();
  return joining.verdict;
}

std::optional<std::size_t> TeamIntake::take_untied(const MapGraph& graph) {
  while (!unasked_.empty()) {
    const std::size_t node = unasked_.front();
    unasked_.pop_front();
    if (!graph.is_tied_to_own(node)) return node;
  }
  return std::nullopt;
}

std::optional<AlignmentQuery> TeamIntake::take_alignment_query(const MapGraph& graph,
                                                               const MapperParams& params) {
  std::map<Origin, std::vector<KeyframeId>> waiting;
  for (const auto& [id, keyframe] : unplaced_.keyframes()) waiting[id.origin()].push_back(id);
  for (const auto& [origin, ids] : waiting) {
    const std::size_t size = ids.size() + graph.keyframes().size();
    std::size_t& asked_at = aligned_at_[origin];
    if (ids.size() < params.team.keyframes_min ||
        static_cast<double>(size) < params.team.growth * static_cast<double>(asked_at))
      continue;
    asked_at = size;
    return AlignmentQuery{graph.session(), unplaced_.tied_to(ids.front(), params.graph), params};
  }
  return std::nullopt;
}

}  // namespace topo::slam

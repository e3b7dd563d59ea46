// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The part of the mapper that adds the keyframes and relations of team-mates.

#include <algorithm>
#include <utility>

#include "core/slam/mapper.hpp"

namespace topo::slam {
namespace {

/// Keyframes within this many of a tied one count as tied, too: neighbours on a path have little relative
/// error.
constexpr std::size_t kTiedReach = 3;

constexpr std::size_t kAlignFrom = 50;  ///< keyframes of a team-mate: fewer cannot yield agreeing places
constexpr double kAlignGrowth = 1.2;    ///< of both maps together, before the request is repeated

}  // namespace

/// One call of join(): the relations that may enter the map now, odometry before closures, because the first
/// relation that reaches a keyframe determines its pose.
struct Mapper::Joining {
  Mapper& mapper;
  std::set<std::pair<bool, RelationKey>> open{};
  JoinVerdict verdict{};

  void consider(const RelationKey& key) {
    if (const Relation* relation = mapper.unplaced_.find(key)) open.emplace(relation->robust, key);
  }
  void consider_all_at(const KeyframeId& id) {
    for (const RelationKey& key : mapper.unplaced_.at(id)) consider(key);
  }

  void run() {
    while (!open.empty()) {
      const RelationKey key = open.begin()->second;
      open.erase(open.begin());
      settle(key);
    }
  }

  void settle(const RelationKey& key) {
    const Relation* found = mapper.unplaced_.find(key);
    if (found == nullptr) return;
    const Relation relation = *found;
    auto from = mapper.node_of(key.first), to = mapper.node_of(key.second);
    if (!from && !to) return;
    if (!to) to = place(key.second, mapper.poses_[*from] * relation.T_from_to);
    if (!from) from = place(key.first, mapper.poses_[*to] * relation.T_from_to.inverse());
    if (!from || !to) return;
    const Edge edge{*from, *to, relation.T_from_to, relation.information, relation.robust};
    mapper.unplaced_.erase(key);
    mapper.add_edge(edge);
    ++verdict.tied;
  }

  std::optional<std::size_t> place(const KeyframeId& id, const types::Se2& pose) {
    if (!mapper.unplaced_.contains(id)) return std::nullopt;
    const std::size_t node = mapper.add_mates_node(mapper.unplaced_.take(id), pose);
    mapper.unasked_.push_back(node);
    ++verdict.placed;
    consider_all_at(id);
    return node;
  }
};

JoinVerdict Mapper::join(std::span<const KeyframePtr> keyframes, std::span<const FoundRelation> relations) {
  Joining joining{*this};
  for (const FoundRelation& found : relations) {
    if (known_.insert(found.key).second) unplaced_.add(found.key, found.relation);
    joining.consider(found.key);
  }
  for (const KeyframePtr& keyframe : keyframes) {
    if (nodes_.contains(keyframe->id)) continue;
    unplaced_.add(keyframe);
    joining.consider_all_at(keyframe->id);
  }
  joining.run();
  return joining.verdict;
}

bool Mapper::is_own(std::size_t node) const { return std::binary_search(own_.begin(), own_.end(), node); }

std::size_t Mapper::add_mates_node(KeyframePtr keyframe, const types::Se2& pose) {
  const KeyframeId id = keyframe->id;
  std::vector<std::size_t>& way = mates_[id.origin()];
  const auto at = std::upper_bound(way.begin(), way.end(), id, [&](const KeyframeId& a, std::size_t b) {
    return a < keyframes_[b]->id;
  });  // it may have arrived late
  const std::size_t node = keyframes_.size();
  way.insert(at, node);
  return add_node(std::move(keyframe), pose);
}

JoinVerdict Mapper::relate(const RelationKey& key, const Relation& relation) {
  if (known_.contains(key)) return {};
  found_.push_back({{maker_.robot, static_cast<std::uint32_t>(found_.size()), maker_.run}, key, relation});
  const FoundRelation found = found_.back();
  return join({}, {&found, 1});
}

std::span<const FoundRelation> Mapper::found_since(std::uint32_t number) const {
  return std::span(found_).subspan(std::min<std::size_t>(number, found_.size()));
}

std::optional<std::size_t> Mapper::node_of(const KeyframeId& id) const {
  const auto at = nodes_.find(id);
  return at == nodes_.end() ? std::nullopt : std::optional(at->second);
}

std::vector<LoopGroup> Mapper::groups_of_mates(std::size_t node, std::span<const double> distances_m) const {
  std::vector<std::pair<LoopRun, Way>> runs;
  for (const auto& [origin, way] : mates_) {
    for (const LoopRun& run : find_loop_runs(poses_, distances_m, node, way, way.size(), params_.loop))
      runs.emplace_back(run, way);
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const auto& a, const auto& b) { return a.first.distance_m < b.first.distance_m; });
  std::vector<LoopGroup> groups;
  for (const auto& [run, way] : runs) {
    if (groups.size() == static_cast<std::size_t>(params_.loop.groups_max)) break;
    groups.push_back(group_of(run, way));
  }
  return groups;
}

bool Mapper::is_tied_to_own_way(std::size_t node) const {
  const std::vector<std::size_t>& way = mates_.at(keyframes_[node]->id.origin());
  const auto place = static_cast<std::size_t>(std::find(way.begin(), way.end(), node) - way.begin());
  const std::size_t first = place > kTiedReach ? place - kTiedReach : 0;
  const std::size_t last = std::min(place + kTiedReach, way.size() - 1);
  for (std::size_t k = first; k <= last; ++k) {
    if (tied_.contains(way[k])) return true;
  }
  return false;
}

std::vector<LoopQuery> Mapper::take_mate_queries(std::size_t count_max) {
  std::vector<LoopQuery> queries;
  for (; !unasked_.empty() && queries.size() < count_max; unasked_.pop_front()) {
    const std::size_t node = unasked_.front();
    if (is_tied_to_own_way(node)) continue;
    const std::vector<double> distances_m = links_.distances_m(poses_.size(), node);
    LoopQuery query = query_about(node);
    for (const LoopRun& run : find_loop_runs(poses_, distances_m, node, own_, own_.size(), params_.loop))
      query.groups.push_back(group_of(run, own_));
    if (!query.groups.empty()) queries.push_back(std::move(query));
  }
  return queries;
}

std::optional<AlignmentQuery> Mapper::take_alignment_query() {
  std::map<Origin, std::vector<KeyframeId>> waiting;
  for (const auto& [id, keyframe] : unplaced_.keyframes()) waiting[id.origin()].push_back(id);
  for (const auto& [origin, ids] : waiting) {
    const std::size_t size = ids.size() + keyframes_.size();
    std::size_t& asked_at = aligned_at_[origin];
    if (ids.size() < kAlignFrom || static_cast<double>(size) < kAlignGrowth * static_cast<double>(asked_at))
      continue;
    asked_at = size;
    return AlignmentQuery{session(), unplaced_.tied_to(ids.front(), params_.graph), params_};
  }
  return std::nullopt;
}

}  // namespace topo::slam

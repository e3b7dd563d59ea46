// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/mates_frame.hpp"

#include "core/slam/known_starts.hpp"

namespace topo::team {
namespace {

slam::KeyframeId id_of(const StatusMessage& sender, const Anchor& anchor) {
  return {sender.robot, anchor.sequence, anchor.run};
}

/// The first keyframe of the run, whose pose is the configured start.
const Anchor* start_anchor(const StatusMessage& message) {
  if (!message.in_common_frame || message.anchors.empty()) return nullptr;
  return message.anchors.front().sequence == 0 ? &message.anchors.front() : nullptr;
}

}  // namespace

std::vector<slam::KeyframeId> anchor_ids(const StatusMessage& mate) {
  std::vector<slam::KeyframeId> ids;
  for (const Anchor& anchor : mate.anchors) ids.push_back(id_of(mate, anchor));
  return ids;
}

std::optional<types::Se2> mates_frame(const StatusMessage& mate, bool in_common_frame,
                                      const PoseOf& pose_of) {
  for (auto anchor = mate.anchors.rbegin(); anchor != mate.anchors.rend(); ++anchor) {
    if (const auto here = pose_of(id_of(mate, *anchor))) return *here * anchor->T_map_base.inverse();
  }
  return in_common_frame && mate.in_common_frame ? std::optional(types::Se2{}) : std::nullopt;
}

std::optional<std::pair<slam::RelationKey, slam::Relation>> relation_of_starts(const StatusMessage& own,
                                                                               const StatusMessage& mate) {
  const Anchor *const a = start_anchor(own), *const b = start_anchor(mate);
  if (a == nullptr || b == nullptr) return std::nullopt;
  return slam::known_starts(id_of(own, *a), a->T_map_base, id_of(mate, *b), b->T_map_base);
}

}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/relation_set.hpp"
#include "core/team/status_message.hpp"

// How the maps of two robots lie to each other.
namespace topo::team {

/// The pose of a keyframe in this robot's map; nothing when the map does not hold it.
using PoseOf = std::function<std::optional<types::Se2>(const slam::KeyframeId& id)>;

/// The ids of a status message's anchors.
[[nodiscard]] std::vector<slam::KeyframeId> anchor_ids(const StatusMessage& mate);

/// A team-mate's map frame in this robot's, by the latest of its anchors that this robot's map holds: both
/// maps bend, and are most alike where the mate is. Without one the identity when both maps are in the common
/// frame, else nothing.
[[nodiscard]] std::optional<types::Se2> mates_frame(const StatusMessage& mate, bool in_common_frame,
                                                    const PoseOf& pose_of);

/// The relation between the first keyframes of two robots that both started at poses in the common frame; the
/// same for both robots. Nothing when one of them did not, or has no keyframe yet. `own`: as said to mates.
[[nodiscard]] std::optional<std::pair<slam::RelationKey, slam::Relation>> relation_of_starts(
    const StatusMessage& own, const StatusMessage& mate);

}  // namespace topo::team

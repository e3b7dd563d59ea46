// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "core/slam/keyframe_set.hpp"
#include "core/slam/map_builder.hpp"
#include "core/slam/pose_graph.hpp"
#include "core/slam/relation_set.hpp"
#include "core/slam/session.hpp"

namespace topo::slam {

/// A map that depends only on the sets it was built from. Belongs to the thread that built it.
struct CanonicalMap {
  std::vector<KeyframeId> ids;    ///< connected to the origin by relations, in the order of their keys
  std::vector<types::Se2> poses;  ///< T_map_base of each
  std::unique_ptr<MapBuilder> map;
};

/// The keyframes that relations connect to `origin`, in the order of the keys. The poses are chained from the
/// origin along a spanning tree, each robot's odometry before relations between robots, and then solved with
/// the origin at zero (DESIGN section 3, "SLAM"). The same sets give the same bits on one machine type; which
/// robot has the lower id matters only to rounding. Keyframes without a connection to the origin are left out
/// (another robot's map, until it is found in this one), as are relations with an end outside the set. Empty
/// when the origin is not in the set.
Session canonical_session(const KeyframeSet& keyframes, const RelationSet& relations,
                          const KeyframeId& origin, const GraphParams& params);

/// The map of a set: canonical_session, drawn in the order of the keys on one thread.
CanonicalMap canonical_map(const KeyframeSet& keyframes, const RelationSet& relations,
                           const KeyframeId& origin, const GraphParams& graph, const GridParams& grid);

}  // namespace topo::slam

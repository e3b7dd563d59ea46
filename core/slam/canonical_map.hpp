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

/// A map that depends on nothing but the sets it was made of. Belongs to the thread that made it.
struct CanonicalMap {
  std::vector<KeyframeId> ids;    ///< those that relations tie to the origin, in the order of their keys
  std::vector<types::Se2> poses;  ///< T_map_base of each
  std::unique_ptr<MapBuilder> map;
};

/// What relations tie to `origin`, in the order of the keys: poses chained from it along a spanning tree,
/// each robot's odometry before what ties robots, and solved with it at zero (DESIGN section 3, "SLAM"). The
/// same sets give the same bits on one machine type, and whoever has the lower id does not matter but for
/// rounding. What nothing ties to it is left out: another robot's map, until one is found in the other. Empty
/// when the origin is not in the set; relations with an end that is not are left out.
Session canonical_session(const KeyframeSet& keyframes, const RelationSet& relations,
                          const KeyframeId& origin, const GraphParams& params);

/// The map of a set: canonical_session, drawn in that order on one thread.
CanonicalMap canonical_map(const KeyframeSet& keyframes, const RelationSet& relations,
                           const KeyframeId& origin, const GraphParams& graph, const GridParams& grid);

}  // namespace topo::slam

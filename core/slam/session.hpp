// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/pose_graph.hpp"
#include "core/types/result.hpp"

namespace topo::slam {

/// Everything that a map is made of: what is saved, and what mapping goes on from. Keyframes are immutable,
/// so that copies share them.
struct Session {
  std::vector<KeyframePtr> keyframes;
  std::vector<types::Se2> poses;  ///< T_map_base of each keyframe
  std::vector<Edge> edges;        ///< between keyframes, by their place in the list
};

/// Whether a session from outside is one: a pose for every keyframe, edges between keyframes that are there,
/// every number finite. kInvalidInput names the first fault.
[[nodiscard]] types::Status check_session(const Session& session);

/// Where a robot stands in a session's map, and by which scan that is known.
struct Arrival {
  Cloud cloud;                                            ///< a deskewed scan
  types::Se2 T_odom_base;                                 ///< dead reckoning at the cloud's stamp
  types::Se2 T_map_base;                                  ///< found for that stamp
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of the scan's match, map axes
};

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/slam/keyframe.hpp"
#include "core/slam/pose_graph.hpp"
#include "core/types/result.hpp"

namespace topo::slam {

/// The complete content of a map: what is saved, and from which mapping continues. Keyframes are immutable,
/// so that copies share them.
struct Session {
  std::vector<KeyframePtr> keyframes;
  std::vector<types::Se2> poses;  ///< T_map_base of each keyframe
  std::vector<Edge> edges;        ///< between keyframes, by their index in the list
};

/// True for a pose that a map may have; one from a hostile file must not make cell numbers overflow.
[[nodiscard]] bool is_in_reach(const types::Se2& pose);

/// Checks a session from outside: a pose for every keyframe, edges between existing keyframes, poses and
/// edges finite and in range. kInvalidInput names the first fault.
[[nodiscard]] types::Status check_session(const Session& session);

/// Places in the list of the keyframes of one robot, of all its runs: its path.
[[nodiscard]] std::vector<std::size_t> way_of(std::span<const KeyframePtr> keyframes, std::uint16_t robot);

/// Whether it is known who found an edge.
[[nodiscard]] inline bool has_finder(const Edge& edge) { return edge.finder.run != 0; }

/// A robot's pose in a session's map, and the scan that determined it.
struct Arrival {
  Cloud cloud;                                            ///< a deskewed scan
  types::Se2 T_odom_base;                                 ///< dead reckoning at the cloud's stamp
  types::Se2 T_map_base;                                  ///< found for that stamp
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();  ///< of the scan's match, map axes
  std::vector<types::Se2> rivals{};                       ///< other poses in map that fit nearly as well
};

}  // namespace topo::slam

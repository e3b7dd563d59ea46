// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>

#include "core/slam/free_ground.hpp"
#include "core/slam/params.hpp"
#include "core/slam/refine.hpp"
#include "core/slam/surfel_map.hpp"
#include "core/types/stamp.hpp"

namespace topo::slam {

/// The robot's pose at the scan placed last, and its motion between the last two.
struct TrackedMotion {
  types::Stamp stamp{};
  types::Se2 T_map_base, T_odom_base;
  types::Se2 T_previous_last;    ///< between the two scans placed last
  double previous_last_s = 0.0;  ///< time between them; 0 before there are two
};

/// The pose that odometry gives for the time of a scan, `seconds` after the last. Odometry that was set to
/// another place (a base that was switched off and on) reports a motion that no robot drives: then the motion
/// before continues.
[[nodiscard]] Prior predict(const TrackedMotion& last, const types::Se2& T_odom_base, double seconds,
                            const MotionNoise& noise);

/// The same motion as between the two scans before, with three times the standard deviation of odometry.
[[nodiscard]] Prior continued(const TrackedMotion& last, double seconds, const MotionNoise& noise);

/// What the pose of a scan is searched for in.
struct TrackingMap {
  const SurfelMap& surfels;
  std::function<FreeGround()> ground;  ///< ground that was seen through; called only when needed
};

/// Points of a scan in base_link, seen from `sensor`.
struct TrackedPoints {
  std::span<const Point> points;
  Point sensor;
};

struct Tracked {
  Match match;
  bool kept = false;      ///< false: nothing fits, the pose is odometry's
  bool searched = false;  ///< the correlative search was needed
};

/// Places a scan: refinement from the prior; when that is poor, a search around the prior and around the
/// continued motion; when nothing fits, a search over all headings. A pose far from odometry's fits very well
/// or explains what the scan contradicts at odometry's place: a corridor looks alike every few metres. After
/// a long motion a poor fit is also searched for further away: wheels that slip, or encoders without a sense
/// of direction, make odometry wrong by up to twice the distance driven, and half of another room may fit at
/// the wrong place.
[[nodiscard]] Tracked track(const TrackingMap& map, const TrackedPoints& scan, const TrackedMotion& last,
                            const Prior& prior, const Prior& continued, const MapperParams& params);

}  // namespace topo::slam

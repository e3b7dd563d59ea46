// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

#include "core/types/robot_limits.hpp"
#include "core/types/stamp.hpp"

namespace topo::pipeline {

/// Dead reckoning at the times of beams (odometry_buffer.hpp).
struct OdometryBufferParams {
  types::Duration kept = std::chrono::seconds(3);  ///< longer than any scan waits
  /// Past the newest sample the pose is extrapolated for so long: the gate stops a robot whose status is
  /// older.
  types::Duration extrapolated_max = types::RobotLimits{}.status_age_max;
};

/// Drawing of corrected poses (map_drawing.hpp).
struct DrawingParams {
  /// Beams and columns redrawn with each scan: a correction of half an hour of data is shown after some
  /// seconds.
  std::size_t redrawn_a_scan = 6000;
  /// The small displacements that a correction leaves are drawn when no other correction has come for this
  /// time: so many keyframes with each scan, since nothing waits for them.
  types::Duration settle_after = std::chrono::seconds(5);
  std::size_t settled_a_scan = 1;
};

/// Of mapping_step(), beside slam::MapperParams.
struct MappingStepParams {
  std::size_t scans_waiting_max = 16;  ///< for odometry, of one scanner: 0.4 s at 40 Hz
  OdometryBufferParams odometry;
  DrawingParams drawing;
  /// A standing robot makes no keyframes: news waits this long for one. Each change of the map costs an
  /// analysis.
  types::Duration news_wait = std::chrono::seconds(1);
  /// A robot that has made no keyframe for so long searches its own past (slam::OwnPast::take_idle), a
  /// stretch each time: the closure thread has a second of work then.
  types::Duration idle_after = std::chrono::seconds(5);
  std::size_t mate_queries_max = 2;  ///< of team-mates' keyframes, at one keyframe boundary
};

}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/calibration/drive_log.hpp"
#include "core/calibration/params.hpp"
#include "core/calibration/wheel_track.hpp"

namespace topo::calibration {

/// Pose of the front scanner itself at the middle of one sweep, by matching.
struct ScanPose {
  double stamp_s = 0.0;
  types::Se2 T_map_laser;
  double response = 0.0;    ///< share of the points that fit
  bool matched = false;     ///< false: lost, the pose is the wheels'
  bool degenerate = false;  ///< one direction is not determined by the scan
};

/// Places every front scan of a drive against those before it. The scanner is tracked and not the robot, so
/// that its place on the robot does not enter; `numbers` only undistorts the sweeps and says where to look.
/// Scans without odometry are left out.
[[nodiscard]] std::vector<ScanPose> track_scans(const DriveLog& drive, const WheelTrack& wheels,
                                                const RobotNumbers& numbers,
                                                const slam::MapperParams& params);

}  // namespace topo::calibration

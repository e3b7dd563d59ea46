// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/calibration/drive_log.hpp"
#include "core/calibration/params.hpp"
#include "core/calibration/wheel_track.hpp"
#include "core/walls/coronal_mount.hpp"

namespace topo::calibration {

/// Roll and height of the coronal scanner from the floor, its place ahead and aside from walls that the front
/// scanner sees too. Each pair is there only where it was determined.
struct CoronalFit {
  std::size_t floor_points = 0, wall_points = 0;
  double floor_extent_m = 0.0;  ///< from left to right
  bool has_floor = false, has_walls = false;
  double roll_rad = 0.0, sigma_roll_rad = 0.0;
  double z_m = 0.0, sigma_z_m = 0.0;
  double x_m = 0.0, sigma_x_m = 0.0;
  double y_m = 0.0, sigma_y_m = 0.0;
};

/// `before`: the mount that is assumed; `front_z_m`: height of the front scanner. Nothing without coronal
/// scans. The floor is taken to be level where the robot stands.
[[nodiscard]] std::optional<CoronalFit> fit_coronal(const DriveLog& drive, const WheelTrack& wheels,
                                                    const RobotNumbers& numbers,
                                                    const walls::CoronalMount& before, double front_z_m,
                                                    const CalibrationParams& params);

}  // namespace topo::calibration

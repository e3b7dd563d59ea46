// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/slam/params.hpp"

namespace topo::slam {

/// Information of an edge from the information of a match: rotated from map axes into the axes of the matched
/// pose, and bounded from above, because the errors of neighbouring points are not independent and the
/// surfaces matched against have an accuracy of their own.
Eigen::Matrix3d edge_information(const Eigen::Matrix3d& information_map, double theta_rad,
                                 double trans_floor_m, double rot_floor_rad);

/// Information of the pose after a motion measured by odometry; equal along and across the motion, therefore
/// the same in all axes.
Eigen::Matrix3d motion_information(const types::Se2& T_last_now, const MotionNoise& noise);

/// False for a motion that no robot drives within these seconds: odometry was set to another place.
[[nodiscard]] bool is_drivable(const types::Se2& motion, double seconds, const MotionNoise& noise);

}  // namespace topo::slam

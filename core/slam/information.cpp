// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/information.hpp"

#include <Eigen/LU>
#include <cmath>

namespace topo::slam {
namespace {

Eigen::Matrix3d turned(const Eigen::Matrix3d& matrix, double angle_rad) {
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  r.topLeftCorner<2, 2>() << std::cos(angle_rad), -std::sin(angle_rad), std::sin(angle_rad),
      std::cos(angle_rad);
  return r * matrix * r.transpose();
}

}  // namespace

Eigen::Matrix3d edge_information(const Eigen::Matrix3d& information_map, double theta_rad,
                                 double trans_floor_m, double rot_floor_rad) {
  Eigen::Matrix3d regular = information_map;
  regular.diagonal().array() += 1e-6;  // 1 km for a direction without any evidence
  Eigen::Matrix3d covariance = turned(regular.inverse(), -theta_rad);
  covariance.diagonal() += Eigen::Vector3d(trans_floor_m * trans_floor_m, trans_floor_m * trans_floor_m,
                                           rot_floor_rad * rot_floor_rad);
  const Eigen::Matrix3d information = covariance.inverse();
  return 0.5 * (information + information.transpose());
}

Eigen::Matrix3d motion_information(const types::Se2& T_last_now, const MotionNoise& noise) {
  const double distance = std::hypot(T_last_now.x_m, T_last_now.y_m);
  const double turn = std::abs(T_last_now.theta_rad);
  const double trans = noise.trans_floor_m + noise.trans_per_m * distance;
  const double rot = noise.rot_floor_rad + noise.rot_per_rad * turn + noise.rot_per_m_rad * distance;
  return Eigen::Vector3d(1.0 / (trans * trans), 1.0 / (trans * trans), 1.0 / (rot * rot)).asDiagonal();
}

bool is_drivable(const types::Se2& motion, double seconds, const MotionNoise& noise) {
  const double way_m = std::hypot(motion.x_m, motion.y_m);
  return way_m <= noise.jump_min_m || way_m <= noise.speed_max_mps * seconds;
}

}  // namespace topo::slam

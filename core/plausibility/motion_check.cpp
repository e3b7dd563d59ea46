// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/motion_check.hpp"

#include <algorithm>
#include <cmath>

namespace topo::plausibility {

bool is_impossible(const types::Odometry* before, const types::Odometry& now, const types::ModelSize& model,
                   const MotionParams& params) {
  const double v_mps = std::abs(now.twist.v_mps), omega_radps = std::abs(now.twist.omega_radps);
  if (!(v_mps <= params.speed_factor * model.v_max_mps)) return true;
  if (!(omega_radps <= params.speed_factor * model.omega_max_radps)) return true;
  if (before == nullptr) return false;
  const double elapsed_s = std::max(types::to_seconds(now.stamp - before->stamp), 0.0);
  const types::Se2 step = before->T_odom_base.se2().inverse() * now.T_odom_base.se2();
  const double v_top_mps = std::max(v_mps, std::abs(before->twist.v_mps)) + params.v_slack_mps;
  const double omega_top_radps =
      std::max(omega_radps, std::abs(before->twist.omega_radps)) + params.omega_slack_radps;
  return !(step.translation().norm() <= v_top_mps * elapsed_s + params.step_m) ||
         !(std::abs(types::wrap_angle(step.theta_rad)) <= omega_top_radps * elapsed_s + params.step_rad);
}

}  // namespace topo::plausibility

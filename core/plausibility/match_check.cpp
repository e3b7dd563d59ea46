// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/match_check.hpp"

#include <algorithm>
#include <cmath>

namespace topo::plausibility {

MatchedMotion after_scan(const MatchedMotion& before, types::Stamp stamp, const types::Se2& T_previous_now,
                         const types::Se2& T_odom_base, bool matched) {
  return {stamp, before.T_start_matched * T_previous_now, T_odom_base, matched};
}

bool disagree(const types::Se2& matched, const types::Se2& odom, const MatchParams& params) {
  const double apart_m = (matched.translation() - odom.translation()).norm();
  const double way_m = std::max(matched.translation().norm(), odom.translation().norm());
  const double apart_rad = std::abs(types::wrap_angle(matched.theta_rad - odom.theta_rad));
  const double turn_rad = std::max(std::abs(matched.theta_rad), std::abs(odom.theta_rad));
  return apart_m > params.floor_m + params.share_m * way_m ||
         apart_rad > params.floor_rad + params.share_rad * turn_rad;
}

bool MatchCheck::judge(const MatchedMotion& motion) {
  if (!motion.matched) {
    begin_ = {};
    return disagrees();
  }
  if (begin_.stamp == types::Stamp{} || motion.stamp < begin_.stamp) {
    begin_ = motion;
    return disagrees();
  }
  if (motion.stamp - begin_.stamp < params_.window) return disagrees();
  const types::Se2 matched = begin_.T_start_matched.inverse() * motion.T_start_matched;
  const types::Se2 odom = begin_.T_start_odom.inverse() * motion.T_start_odom;
  windows_ = disagree(matched, odom, params_) ? windows_ + 1 : 0;
  begin_ = motion;
  return disagrees();
}

}  // namespace topo::plausibility

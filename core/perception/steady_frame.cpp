// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/steady_frame.hpp"

#include <cmath>
#include <utility>

namespace topo::perception {
namespace {

/// True when wheel slip or a wrong wheel size can explain the correction. A loss on both wheels displaces the
/// robot's centre by its length; a loss on one wheel turns the robot by its length over the track. A turn on
/// the spot rolls the wheels as well.
bool is_drift(const types::Se2& by, const types::Se2& way, const SteadyFrameParams& p) {
  const double lost_m = p.slip_share * (way.translation().norm() + p.half_track_m * std::abs(way.theta_rad));
  return by.translation().norm() <= p.match_noise_m + lost_m &&
         std::abs(by.theta_rad) <= p.match_noise_rad + 0.5 * lost_m / p.half_track_m;
}

}  // namespace

void SteadyFrame::update(const types::Transform2<types::Map, types::Odom>& T_map_odom, std::uint32_t bends,
                         const types::Odometry& odometry) {
  if (std::exchange(bends_, bends) != bends) lose();
  const types::Se2& now = T_map_odom.se2();
  const types::Se2& T_odom_base = odometry.T_odom_base.se2();
  if (T_map_odom_) {
    // The correction in the robot's frame: far from the origin a small turn of odom is a large displacement.
    const types::Se2 by = (*T_map_odom_ * T_odom_base).inverse() * (now * T_odom_base);
    const types::Se2 way = T_odom_base_.inverse() * T_odom_base;
    if (is_drift(by, way, params_))
      T_steady_odom_ = T_steady_odom_ * T_odom_base * by * T_odom_base.inverse();
  }
  T_map_odom_ = now;
  T_odom_base_ = T_odom_base;
}

types::Odometry SteadyFrame::steady(const types::Odometry& odometry) const {
  types::Odometry out = odometry;
  out.T_odom_base = types::Transform2<types::Odom, types::Base>(T_steady_odom_ * odometry.T_odom_base.se2());
  return out;
}

}  // namespace topo::perception

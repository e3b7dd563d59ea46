// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/odometry_buffer.hpp"

#include <algorithm>

namespace topo::pipeline {

void OdometryBuffer::add(const types::Odometry& odometry) {
  if (!samples_.empty() && odometry.stamp <= samples_.back().stamp) return;
  samples_.push_back(odometry);
  while (samples_.front().stamp + params_.kept < odometry.stamp) samples_.pop_front();
}

std::optional<types::Se2> OdometryBuffer::at(types::Stamp stamp) const {
  if (samples_.empty()) return std::nullopt;
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), stamp,
                                      [](const types::Odometry& o, types::Stamp t) { return o.stamp < t; });
  if (after == samples_.begin()) return after->T_odom_base.se2();
  if (after == samples_.end()) {
    const types::Odometry& last = samples_.back();
    const double dt = types::to_seconds(std::min(stamp - last.stamp, params_.extrapolated_max));
    return last.T_odom_base.se2() * types::Se2{last.twist.v_mps * dt, 0.0, last.twist.omega_radps * dt};
  }
  const types::Odometry& before = *std::prev(after);
  const double t = types::to_seconds(stamp - before.stamp) / types::to_seconds(after->stamp - before.stamp);
  return types::interpolate(before.T_odom_base.se2(), after->T_odom_base.se2(), t);
}

}  // namespace topo::pipeline

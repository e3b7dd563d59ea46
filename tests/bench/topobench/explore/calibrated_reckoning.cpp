// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/calibrated_reckoning.hpp"

#include <cmath>

#include "drivers/pioneer/robot_models.hpp"

namespace topo::bench {
namespace {

/// 15 bits of whole millimetres, which are the counts of this family.
std::uint16_t counts_of(double way_m) {
  constexpr unsigned kBits = 0x7FFF;
  return static_cast<std::uint16_t>(static_cast<unsigned>(std::lround(1e3 * way_m)) & kBits);
}

pioneer::StatusPacket packet_of(const types::Se2& pose) {
  pioneer::StatusPacket packet;
  packet.x_counts = counts_of(pose.x_m);
  packet.y_counts = counts_of(pose.y_m);
  packet.heading_units =
      static_cast<std::int16_t>(std::lround(pose.theta_rad / pioneer::radians_per_heading_unit()));
  return packet;
}

}  // namespace

CalibratedReckoning::CalibratedReckoning(const types::WheelCalibration& wheels)
    : wheels_(wheels), model_(*pioneer::find_model("p3dx-sh")) {
  reckoning_.restart(model_, types::kP3dx.v_max_mps, types::kP3dx.omega_max_radps, wheels_);
}

types::Odometry CalibratedReckoning::update(const types::Odometry& counted) {
  if (wheels_ == types::WheelCalibration{}) return counted;
  reckoning_.update(packet_of(counted.T_odom_base.se2()), counted.stamp - last_);
  last_ = counted.stamp;
  types::Odometry out = counted;
  out.T_odom_base = types::Transform2<types::Odom, types::Base>(reckoning_.T_odom_base());
  const types::Progress speed = types::true_progress(wheels_, 2e-3 / model_.radps_per_mmps,
                                                     {counted.twist.v_mps, counted.twist.omega_radps});
  out.twist = {speed.way_m, speed.turn_rad};
  return out;
}

}  // namespace topo::bench

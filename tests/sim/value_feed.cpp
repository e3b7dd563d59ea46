// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/sim/value_feed.hpp"

#include <cmath>
#include <numbers>

namespace topo::sim {
namespace {

types::Stamp stamp_of(SimTime time) { return types::Stamp{time}; }

/// Converts a range as the driver does (PROTOCOLS section 10.2).
float range_of(std::uint32_t mm, const LaserModel& model) {
  if (mm == model.code_no_return) return types::kNoReturn;
  if (mm == model.code_too_near) return types::kTooNear;
  if (mm < static_cast<std::uint32_t>(model.distance_min_mm)) return types::kInvalid;
  if (mm > static_cast<std::uint32_t>(model.distance_max_mm)) return types::kNoReturn;
  return static_cast<float>(mm) * 1e-3F;
}

Se2 as_the_firmware_tells(const Se2& pose) {
  constexpr double kHeading = 2.0 * std::numbers::pi / 4096.0;
  return {std::trunc(pose.x_m * 1e3) * 1e-3, std::trunc(pose.y_m * 1e3) * 1e-3,
          types::wrap_angle(std::trunc(pose.theta_rad / kHeading) * kHeading)};
}

}  // namespace

ValueFeed::ValueFeed(const RobotSetup& setup)
    : scans_(setup.lasers.size()), reckoning_({}, setup.model.track_m) {
  for (const LaserSetup& laser : setup.lasers) models_.push_back(laser.model);
}

void ValueFeed::on_sweep(std::size_t laser, const Sweep& sweep) {
  const LaserModel& model = models_[laser];
  types::Scan& scan = scans_[laser].emplace_back();
  const double step_rad = 2.0 * std::numbers::pi / model.steps_per_turn;
  scan.first_beam = stamp_of(sweep.step0 + model.step_time(sweep.step_min));
  scan.arrival = stamp_of(sweep.end);
  scan.sequence = sweep.number;
  scan.beams = static_cast<std::uint16_t>(sweep.range_mm.size());
  scan.geometry.angle_min_rad = static_cast<float>(model.angle_rad(sweep.step_min));
  scan.geometry.angle_increment_rad = static_cast<float>(step_rad);
  scan.geometry.time_increment_s = static_cast<float>(60.0 / model.rpm / model.steps_per_turn);
  scan.geometry.period_s = static_cast<float>(60.0 / model.rpm);
  scan.geometry.range_min_m = static_cast<float>(model.distance_min_mm) * 1e-3F;
  scan.geometry.range_max_m = static_cast<float>(model.distance_max_mm) * 1e-3F;
  for (std::size_t i = 0; i < scan.beams; ++i) scan.range_m[i] = range_of(sweep.range_mm[i], model);
}

void ValueFeed::sample(const RobotBody& body) {
  reckoning_.update(body);
  if (body.now() < next_sample_) return;
  next_sample_ += kSipPeriod;
  const double v = 0.5 * (body.encoder_left_mps() + body.encoder_right_mps());
  const double omega = (body.encoder_right_mps() - body.encoder_left_mps()) / body.model().track_m;
  odometry_.push_back({stamp_of(body.now()),
                       types::Transform2<types::Odom, types::Base>(as_the_firmware_tells(reckoning_.pose())),
                       {v, omega}});
}

std::optional<types::Odometry> ValueFeed::next_odometry() {
  if (odometry_.empty()) return std::nullopt;
  const types::Odometry sample = odometry_.front();
  odometry_.pop_front();
  return sample;
}

bool ValueFeed::next_scan(std::size_t laser, types::Scan& out) {
  if (scans_[laser].empty()) return false;
  out = scans_[laser].front();
  scans_[laser].pop_front();
  return true;
}

}  // namespace topo::sim

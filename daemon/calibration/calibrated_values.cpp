// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/calibration/calibrated_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "daemon/calibration/refusal_text.hpp"

namespace topo::daemon {
namespace {

constexpr double kWay_m = 10.0, kWall_m = 5.0, kTurning_radps = 1.0;  ///< what effects are told of

std::string wheel_effect(double before, double found) {
  return fmt::format("{:g} m of this wheel were {:.2f} m", kWay_m, kWay_m * found / before);
}

std::string angle_effect(double change_rad) {
  return fmt::format("{:+.2f} degrees; a wall {:g} m away moves by {:.2f} m", in_degrees(change_rad), kWall_m,
                     kWall_m * std::abs(change_rad));
}

std::string place_effect(double change_m) { return fmt::format("{:+.0f} mm", 1e3 * change_m); }

void add_wheels(const calibration::RobotNumbers& found, const calibration::RobotNumbers& before,
                const calibration::Vector& sigma, std::vector<CalibratedValue>& out) {
  const types::WheelCalibration &now = found.wheels, &was = before.wheels;
  out.push_back({"base.wheel_left", was.left, now.left, sigma[calibration::kWheelLeft],
                 wheel_effect(was.left, now.left)});
  out.push_back({"base.wheel_right", was.right, now.right, sigma[calibration::kWheelRight],
                 wheel_effect(was.right, now.right)});
  const double turn = 360.0 * (was.track_m / now.track_m) * (now.left + now.right) / (was.left + was.right);
  out.push_back({"base.track_m", was.track_m, now.track_m, sigma[calibration::kTrack],
                 fmt::format("a turn of 360 degrees was {:.1f}", turn)});
  out.push_back({"base.status_delay_s", before.delay_s, found.delay_s, sigma[calibration::kDelay],
                 fmt::format("at {:g} rad/s headings were {:.1f} degrees apart", kTurning_radps,
                             in_degrees(kTurning_radps * std::abs(found.delay_s - before.delay_s)))});
}

void add_front(const types::Se2& found, const types::Se2& before, const calibration::Vector& sigma,
               std::vector<CalibratedValue>& out) {
  out.push_back({"scanner.front.x_m", before.x_m, found.x_m, sigma[calibration::kPlaceX],
                 place_effect(found.x_m - before.x_m)});
  out.push_back({"scanner.front.y_m", before.y_m, found.y_m, sigma[calibration::kPlaceY],
                 place_effect(found.y_m - before.y_m)});
  out.push_back({"scanner.front.yaw_rad", before.theta_rad, found.theta_rad, sigma[calibration::kYaw],
                 angle_effect(types::wrap_angle(found.theta_rad - before.theta_rad))});
}

void add_coronal(const calibration::CoronalFit& c, const walls::CoronalMount& before,
                 std::vector<CalibratedValue>& out) {
  if (c.has_floor) {
    out.push_back({"scanner.coronal.roll_rad", before.roll_rad, c.roll_rad, c.sigma_roll_rad,
                   angle_effect(types::wrap_angle(c.roll_rad - before.roll_rad))});
    out.push_back({"scanner.coronal.z_m", before.z_m, c.z_m, c.sigma_z_m, place_effect(c.z_m - before.z_m)});
  }
  if (c.has_walls) {
    out.push_back({"scanner.coronal.x_m", before.x_m, c.x_m, c.sigma_x_m, place_effect(c.x_m - before.x_m)});
    out.push_back({"scanner.coronal.y_m", before.y_m, c.y_m, c.sigma_y_m, place_effect(c.y_m - before.y_m)});
  }
}

}  // namespace

std::vector<CalibratedValue> calibrated_values(const calibration::Calibration& found,
                                               const calibration::Assumed& before) {
  std::vector<CalibratedValue> out;
  if (!found.fit) return out;
  const calibration::Vector sigma = found.fit->covariance.diagonal().cwiseSqrt();
  add_wheels(found.fit->numbers, before.numbers, sigma, out);
  add_front(found.fit->numbers.T_base_laser, before.numbers.T_base_laser, sigma, out);
  if (found.coronal) add_coronal(*found.coronal, before.coronal, out);
  return out;
}

std::vector<KeyEdit> edits_of(std::span<const CalibratedValue> values) {
  constexpr int kDigits = 5;
  std::vector<KeyEdit> edits;
  for (const CalibratedValue& v : values) edits.push_back({v.key, fmt::format("{:.{}f}", v.found, kDigits)});
  return edits;
}

}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/blind_spot.hpp"

#include <algorithm>
#include <cmath>

#include "core/perception/footprint_sweep.hpp"
#include "core/perception/moving_obstacles.hpp"
#include "core/types/invariant.hpp"

namespace topo::perception {
namespace {

using types::Se2;
using types::Vector2;

/// Half of the scanner's field of view. A scanner that is mounted upside down has clockwise beams.
double half_view_rad(const types::Scan& scan) {
  return 0.5 * std::abs(static_cast<double>(scan.geometry.angle_increment_rad)) * (scan.beams - 1);
}

/// Angle from the middle of the field of view to a point.
double off_middle_rad(const types::Scan& scan, const Vector2& p_laser) {
  const auto step_rad = static_cast<double>(scan.geometry.angle_increment_rad);
  const double middle_rad =
      static_cast<double>(scan.geometry.angle_min_rad) + 0.5 * step_rad * (scan.beams - 1);
  return types::wrap_angle(std::atan2(p_laser.y(), p_laser.x()) - middle_rad);
}

/// True when the scan has a measurement in a point's direction: false out of view and for invalid beams.
bool tells(const types::Scan& scan, const Vector2& p_laser) {
  const double off_rad = off_middle_rad(scan, p_laser);
  if (!(std::abs(off_rad) < half_view_rad(scan))) return false;
  const double beam =
      off_rad / static_cast<double>(scan.geometry.angle_increment_rad) + 0.5 * (scan.beams - 1);
  const auto i = static_cast<std::size_t>(std::lround(beam));
  if (i >= scan.checked_beams()) return false;
  const float range_m = scan.range_m[i];
  return types::is_hit(range_m) || range_m == types::kNoReturn;
}

bool goes_on(const Se2& before, const Se2& now, const BlindSpotParams& params) {
  return types::distance_m(before, now) < params.jump_m &&
         std::abs(types::wrap_angle(now.theta_rad - before.theta_rad)) < params.jump_rad;
}

bool moves(const Vector2& p_base, std::span<const MovingObstacle> moving, double rim_m) {
  return std::any_of(moving.begin(), moving.end(), [&](const MovingObstacle& m) {
    return (p_base - m.centre).norm() < m.radius_m + rim_m;
  });
}

}  // namespace

void BlindSpot::forget(const types::Scan& scan, const Se2& T_odom_laser) {
  const Se2 T_laser_odom = T_odom_laser.inverse();
  const auto is_over = [&](const Seen& s) {
    return (s.p_odom - T_odom_base_.translation()).squaredNorm() > params_.reach_m * params_.reach_m ||
           scan.arrival - s.last > params_.kept || tells(scan, T_laser_odom * s.p_odom);
  };
  const auto end = std::remove_if(seen_.begin(), seen_.begin() + static_cast<std::ptrdiff_t>(size_), is_over);
  size_ = static_cast<std::size_t>(end - seen_.begin());
}

/// Keeps one point per location; otherwise a surface that leaves the view gradually would fill the array.
void BlindSpot::keep(const Vector2& p_odom, types::Stamp seen) {
  const auto end = seen_.begin() + static_cast<std::ptrdiff_t>(size_);
  const auto there = std::find_if(seen_.begin(), end, [&](const Seen& s) {
    return (s.p_odom - p_odom).squaredNorm() < params_.spacing_m * params_.spacing_m;
  });
  if (there != end) {
    there->last = seen;
    return;
  }
  if (size_ == kMax) {
    std::move(seen_.begin() + 1, seen_.end(), seen_.begin());
    --size_;
  }
  seen_[size_++] = {p_odom, seen};
}

void BlindSpot::update(const types::Scan& scan, const Se2& T_base_laser, std::span<const ScanPoint> points,
                       std::span<const MovingObstacle> moving, const types::Footprint& outline,
                       const types::Odometry& odometry) {
  if (scan.first_beam == scan_ || scan.beams == 0) return;
  scan_ = scan.first_beam;
  const Se2 T_odom_base = pose_at(odometry, scan.first_beam);
  if (!goes_on(T_odom_base_, T_odom_base, params_)) {
    size_ = 0;
    ground_.clear();
  }
  T_odom_base_ = T_odom_base;
  ground_.update(scan, T_base_laser, T_odom_base, outline, params_.ground);
  forget(scan, T_odom_base * T_base_laser);
  const Se2 T_laser_base = T_base_laser.inverse();
  const double leaves_rad = half_view_rad(scan) - params_.leaves_view_rad;
  for (const ScanPoint& point : points) {
    const Vector2& p = point.p_base;
    if (p.squaredNorm() > params_.reach_m * params_.reach_m || contains(outline, p)) continue;
    if (std::abs(off_middle_rad(scan, T_laser_base * p)) < leaves_rad ||
        moves(p, moving, params_.mover_rim_m))
      continue;
    keep(T_odom_base * p, scan.arrival);
  }
}

void BlindSpot::put_points(const Se2& T_odom_base, std::span<ScanPoint> out) const {
  types::require(out.size() <= size_, "perception::BlindSpot: more points asked for than are kept");
  const Se2 T_base_odom = T_odom_base.inverse();
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = {T_base_odom * seen_[i].p_odom, false, true};
}

}  // namespace topo::perception

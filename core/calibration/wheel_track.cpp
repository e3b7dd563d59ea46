// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/wheel_track.hpp"

#include <algorithm>
#include <cmath>

namespace topo::calibration {
namespace {

constexpr double kGap_s =
    0.5;  ///< five status cycles: the driver ends a connection that is silent for longer

types::Progress difference(const types::Progress& a, const types::Progress& b) {
  return {a.way_m - b.way_m, a.turn_rad - b.turn_rad};
}

double sinc(double x) { return std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x; }

/// Way and turn between two poses of one dead reckoning; the way is that of the arc whose chord was told.
types::Progress progress_between(const types::Se2& from, const types::Se2& to) {
  const double turn = types::wrap_angle(to.theta_rad - from.theta_rad);
  const double heading = from.theta_rad + 0.5 * turn;
  const double chord = (to.x_m - from.x_m) * std::cos(heading) + (to.y_m - from.y_m) * std::sin(heading);
  return {chord / sinc(0.5 * turn), turn};
}

/// Hermite's cubic between a at 0 and b at 1 with the slopes there, per interval.
double cubic(double a, double b, double slope_a, double slope_b, double t) {
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * slope_a + (3 * t2 - 2 * t3) * b +
         (t3 - t2) * slope_b;
}

}  // namespace

types::Se2 arc(const types::Progress& progress) {
  const double half = 0.5 * progress.turn_rad;
  const double chord = progress.way_m * sinc(half);
  return {chord * std::cos(half), chord * std::sin(half), progress.turn_rad};
}

WheelTrack::WheelTrack(std::span<const types::Odometry> odometry, double model_track_m)
    : model_track_m_(model_track_m) {
  samples_.reserve(odometry.size());
  types::Progress sum;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    if (i > 0) {
      const types::Progress step =
          progress_between(odometry[i - 1].T_odom_base.se2(), odometry[i].T_odom_base.se2());
      sum = {sum.way_m + step.way_m, sum.turn_rad + step.turn_rad};
    }
    samples_.push_back({types::to_seconds(odometry[i].stamp), sum});
  }
}

std::size_t WheelTrack::before(double stamp_s) const {
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), stamp_s,
                                      [](double t, const Sample& s) { return t < s.stamp_s; });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - samples_.begin() - 1, 0));
}

/// Progress per second at a sample, from its neighbours.
types::Progress WheelTrack::rate(std::size_t i) const {
  const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, samples_.size() - 1);
  const double dt = samples_[b].stamp_s - samples_[a].stamp_s;
  const types::Progress d = difference(samples_[b].counted, samples_[a].counted);
  return {d.way_m / dt, d.turn_rad / dt};
}

std::optional<types::Progress> WheelTrack::at(double stamp_s) const {
  if (samples_.size() < 2 || stamp_s < samples_.front().stamp_s || stamp_s >= samples_.back().stamp_s)
    return std::nullopt;
  const std::size_t i = before(stamp_s);
  const Sample &a = samples_[i], &b = samples_[i + 1];
  const double dt = b.stamp_s - a.stamp_s;
  if (dt > kGap_s) return std::nullopt;
  const double t = (stamp_s - a.stamp_s) / dt;
  const types::Progress ra = rate(i), rb = rate(i + 1);
  return types::Progress{
      cubic(a.counted.way_m, b.counted.way_m, ra.way_m * dt, rb.way_m * dt, t),
      cubic(a.counted.turn_rad, b.counted.turn_rad, ra.turn_rad * dt, rb.turn_rad * dt, t)};
}

BasePath::BasePath(const WheelTrack& track, const types::WheelCalibration& wheels)
    : track_(track), wheels_(wheels) {
  poses_.reserve(track.size());
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (i == 0) {
      poses_.emplace_back();
      continue;
    }
    const types::Progress step = difference(track.counted(i), track.counted(i - 1));
    poses_.push_back(poses_.back() * arc(types::true_progress(wheels, track.model_track_m(), step)));
  }
}

std::optional<types::Se2> BasePath::at(double stamp_s) const {
  const auto counted = track_.at(stamp_s);
  if (!counted) return std::nullopt;
  const std::size_t i = track_.before(stamp_s);
  const types::Progress step = difference(*counted, track_.counted(i));
  return poses_[i] * arc(types::true_progress(wheels_, track_.model_track_m(), step));
}

}  // namespace topo::calibration

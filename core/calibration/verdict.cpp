// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace topo::calibration {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// Turns of the wheels and of the scanner over the intervals: positive when they agree.
double agreement(const WheelTrack& wheels, std::span<const Interval> intervals) {
  double sum = 0.0;
  for (const Interval& interval : intervals) {
    const auto from = wheels.at(interval.from_s), to = wheels.at(interval.to_s);
    if (from && to) sum += std::sin(to->turn_rad - from->turn_rad) * std::sin(interval.T_from_to.theta_rad);
  }
  return sum;
}

void add_motion(const WheelTrack& wheels, DriveEvidence& out) {
  if (wheels.size() == 0) return;
  out.seconds = wheels.stamp_s(wheels.size() - 1) - wheels.stamp_s(0);
  for (std::size_t i = 1; i < wheels.size(); ++i) {
    const double turn = wheels.counted(i).turn_rad - wheels.counted(i - 1).turn_rad;
    out.way_m += std::abs(wheels.counted(i).way_m - wheels.counted(i - 1).way_m);
    (turn > 0.0 ? out.turned_left_rad : out.turned_right_rad) += std::abs(turn);
  }
}

void add_matching(std::span<const ScanPose> poses, DriveEvidence& out) {
  out.scans = poses.size();
  if (poses.empty()) return;
  std::vector<double> responses;
  std::size_t matched = 0, degenerate = 0;
  for (const ScanPose& pose : poses) {
    responses.push_back(pose.response);
    matched += pose.matched ? 1U : 0U;
    degenerate += pose.degenerate ? 1U : 0U;
  }
  const auto middle = responses.begin() + static_cast<std::ptrdiff_t>(responses.size() / 2);
  std::nth_element(responses.begin(), middle, responses.end());
  out.response = *middle;
  out.matched = share(matched, poses.size());
  out.degenerate = share(degenerate, poses.size());
}

/// What the drive lacked, whatever the numbers are.
std::vector<Refusal> judge_drive(const DriveEvidence& e, const VerdictParams& p) {
  std::vector<Refusal> out;
  const auto at_least = [&out](Doubt doubt, double found, double needed) {
    if (found < needed) out.push_back({doubt, std::nullopt, found, needed});
  };
  if (e.seconds <= 0.0) return {{Doubt::kNoOdometry, std::nullopt, 0.0, p.drive_min_s}};
  if (e.scans == 0) return {{Doubt::kNoScans, std::nullopt, 0.0, 1.0}};
  at_least(Doubt::kShort, e.seconds, p.drive_min_s);
  at_least(Doubt::kNoWay, e.way_m, p.way_min_m);
  at_least(Doubt::kNoTurnLeft, e.turned_left_rad, p.turn_min_rad);
  at_least(Doubt::kNoTurnRight, e.turned_right_rad, p.turn_min_rad);
  at_least(Doubt::kUnmatched, e.matched, p.matched_min);
  if (e.degenerate > p.degenerate_max)
    out.push_back({Doubt::kDegenerate, std::nullopt, e.degenerate, p.degenerate_max});
  at_least(Doubt::kPoorFit, e.response, p.response_min);
  if (e.against_wheels) out.push_back({Doubt::kAgainstWheels, std::nullopt, 0.0, 0.0});
  return out;
}

void judge_numbers(const Fit& fit, double model_track_m, const VerdictParams& p, std::vector<Refusal>& out) {
  const Vector value = to_vector(fit.numbers), sigma = fit.covariance.diagonal().cwiseSqrt();
  struct Bound {
    double sigma_max, low, high;
  };
  const std::array<Bound, kNumbers> bounds{
      Bound{p.sigma_wheel, 1.0 - p.wheel_error_max, 1.0 + p.wheel_error_max},
      Bound{p.sigma_wheel, 1.0 - p.wheel_error_max, 1.0 + p.wheel_error_max},
      Bound{p.sigma_track * model_track_m, model_track_m * (1.0 - p.track_error_max),
            model_track_m * (1.0 + p.track_error_max)},
      Bound{p.sigma_yaw_rad, -M_PI, M_PI},
      Bound{p.sigma_place_m, -p.place_max_m, p.place_max_m},
      Bound{p.sigma_place_m, -p.place_max_m, p.place_max_m},
      Bound{p.sigma_delay_s, p.delay_min_s, p.delay_max_s}};
  for (int n = 0; n < kNumbers; ++n) {
    const Bound& bound = bounds[static_cast<std::size_t>(n)];
    const auto number = static_cast<Number>(n);
    if (sigma[n] > bound.sigma_max) out.push_back({Doubt::kUncertain, number, sigma[n], bound.sigma_max});
    if (value[n] < bound.low || value[n] > bound.high)
      out.push_back({Doubt::kImpossible, number, value[n], value[n] < bound.low ? bound.low : bound.high});
  }
}

}  // namespace

DriveEvidence gather(const WheelTrack& wheels, std::span<const ScanPose> poses,
                     std::span<const Interval> intervals, const std::optional<Fit>& fit) {
  DriveEvidence out;
  add_motion(wheels, out);
  add_matching(poses, out);
  out.intervals = intervals.size();
  out.left_out = fit ? fit->left_out() : 0.0;
  out.against_wheels = agreement(wheels, intervals) < 0.0;
  return out;
}

std::vector<Refusal> judge(const DriveEvidence& evidence, const std::optional<Fit>& fit,
                           const std::optional<Shift>& shift, double model_track_m,
                           const VerdictParams& params) {
  std::vector<Refusal> out = judge_drive(evidence, params);
  if (!out.empty()) return out;
  if (!fit) return {{Doubt::kOpen, std::nullopt, 0.0, 0.0}};
  if (shift) return {{Doubt::kMoved, std::nullopt, shift->from_s, 0.0}};
  if (evidence.left_out > params.left_out_max)
    out.push_back({Doubt::kSlipped, std::nullopt, evidence.left_out, params.left_out_max});
  judge_numbers(*fit, model_track_m, params, out);
  return out;
}

}  // namespace topo::calibration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/closed_form.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace topo::calibration {
namespace {

constexpr double kSingular = 1e-7;  ///< least ratio of the eigenvalues of a system that is solved

struct Travel {
  double left_m = 0.0, right_m = 0.0;
};

std::optional<Travel> travel(const WheelTrack& wheels, const Interval& interval, double delay_s) {
  const auto from = wheels.at(interval.from_s + delay_s), to = wheels.at(interval.to_s + delay_s);
  if (!from || !to) return std::nullopt;
  const double way = to->way_m - from->way_m;
  const double half = 0.5 * wheels.model_track_m() * (to->turn_rad - from->turn_rad);
  return Travel{way - half, way + half};
}

/// The measured turn with the whole turns that the wheels made: matching knows it up to these.
double unwrapped(double measured_rad, double counted_rad) {
  return counted_rad + types::wrap_angle(measured_rad - counted_rad);
}

template <class M>
bool is_singular(const M& symmetric) {
  const Eigen::SelfAdjointEigenSolver<M> solver(symmetric, Eigen::EigenvaluesOnly);
  return !(solver.eigenvalues()[0] > kSingular * solver.eigenvalues().tail(1)[0]);
}

/// Sums of the second system: unknowns track, x, y, cos, sin.
using System = Eigen::Matrix<double, 5, 5>;

void add_interval(System& sum, const types::Se2& T_from_to_per_track, const types::Se2& seen) {
  const double c = std::cos(T_from_to_per_track.theta_rad), s = std::sin(T_from_to_per_track.theta_rad);
  Eigen::Matrix<double, 2, 5> q;
  q << T_from_to_per_track.x_m, c - 1.0, -s, -seen.x_m, seen.y_m,  //
      T_from_to_per_track.y_m, s, c - 1.0, -seen.y_m, -seen.x_m;
  sum += q.transpose() * q;
}

/// The unknowns that make the squares least while cos^2 + sin^2 = 1: with the first three eliminated, the
/// Lagrange multipliers are the eigenvalues of what is left.
std::optional<Eigen::Matrix<double, 5, 1>> solve(const System& sum) {
  const Eigen::Matrix3d a = sum.topLeftCorner<3, 3>();
  if (is_singular(a)) return std::nullopt;
  const Eigen::Matrix<double, 3, 2> b = sum.topRightCorner<3, 2>();
  const Eigen::Matrix<double, 3, 2> back = a.ldlt().solve(b);
  const Eigen::Matrix2d rest = sum.bottomRightCorner<2, 2>() - b.transpose() * back;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(rest);
  const Eigen::Vector2d heading = solver.eigenvectors().col(0);
  Eigen::Matrix<double, 5, 1> x;
  x << -back * heading, heading;
  return x[0] < 0.0 ? Eigen::Matrix<double, 5, 1>(-x) : x;  // a track is positive
}

}  // namespace

std::optional<Turning> fit_turning(const WheelTrack& wheels, std::span<const Interval> intervals,
                                   const std::vector<bool>& use, double delay_s) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  std::vector<std::optional<Travel>> travels(intervals.size());
  std::vector<double> turns(intervals.size());
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    travels[i] = travel(wheels, intervals[i], delay_s);
    if (!travels[i]) continue;
    const double counted = (travels[i]->right_m - travels[i]->left_m) / wheels.model_track_m();
    turns[i] = unwrapped(intervals[i].T_from_to.theta_rad, counted);
    if (!use[i]) continue;
    const Eigen::Vector2d row(travels[i]->left_m, travels[i]->right_m);
    sum += row * row.transpose();
    right += row * turns[i];
  }
  if (is_singular(sum)) return std::nullopt;
  const Eigen::Vector2d J = sum.ldlt().solve(right);
  Turning out{J[0], J[1], std::vector<double>(intervals.size(), HUGE_VAL)};
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (!use[i] || !travels[i]) continue;
    const double left_over = turns[i] - J[0] * travels[i]->left_m - J[1] * travels[i]->right_m;
    out.square[i] = left_over * left_over;
  }
  return out;
}

std::optional<RobotNumbers> closed_form(const WheelTrack& wheels, std::span<const Interval> intervals,
                                        const std::vector<bool>& use, double delay_s) {
  const auto turning = fit_turning(wheels, intervals, use, delay_s);
  if (!turning || !(turning->j21 < 0.0) || !(turning->j22 > 0.0)) return std::nullopt;
  const BasePath per_track(wheels, {-turning->j21, turning->j22, 1.0});
  System sum = System::Zero();
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (!use[i]) continue;
    const auto from = per_track.at(intervals[i].from_s + delay_s);
    const auto to = per_track.at(intervals[i].to_s + delay_s);
    if (from && to) add_interval(sum, from->inverse() * *to, intervals[i].T_from_to);
  }
  const auto x = solve(sum);
  if (!x || !((*x)[0] > 0.0)) return std::nullopt;
  const double track_m = (*x)[0];
  return RobotNumbers{{-turning->j21 * track_m, turning->j22 * track_m, track_m},
                      {(*x)[1], (*x)[2], std::atan2((*x)[4], (*x)[3])},
                      delay_s};
}

}  // namespace topo::calibration

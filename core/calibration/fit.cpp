// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace topo::calibration {
namespace {

/// Of a normal distribution: standard deviation per median of the absolute value, in one and in two
/// dimensions.
constexpr double kPerMedian = 1.4826, kPerMedian2 = 1.0 / 1.1774;
constexpr double kDelayShare = 0.7;  ///< of the intervals, the best ones, by which delays are compared

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

std::optional<Eigen::Vector3d> predicted(const BasePath& path, const RobotNumbers& numbers,
                                         const Interval& interval) {
  const auto from = path.at(interval.from_s + numbers.delay_s), to = path.at(interval.to_s + numbers.delay_s);
  if (!from || !to) return std::nullopt;
  const types::Se2 seen = (*from * numbers.T_base_laser).inverse() * (*to * numbers.T_base_laser);
  return Eigen::Vector3d(seen.x_m, seen.y_m, seen.theta_rad);
}

using Predictions = std::vector<std::optional<Eigen::Vector3d>>;
Predictions predict(const WheelTrack& wheels, std::span<const Interval> intervals,
                    const RobotNumbers& numbers) {
  const BasePath path(wheels, numbers.wheels);
  Predictions out(intervals.size());
  for (std::size_t i = 0; i < intervals.size(); ++i) out[i] = predicted(path, numbers, intervals[i]);
  return out;
}

Eigen::Vector3d wrapped(Eigen::Vector3d v) {
  v.z() = types::wrap_angle(v.z());
  return v;
}

std::vector<Residual> linearise(const WheelTrack& wheels, std::span<const Interval> intervals,
                                const RobotNumbers& numbers) {
  constexpr double kStep = 1e-4;  // of every number: the model is smooth over centimetres and degrees
  const Vector at = to_vector(numbers);
  const Predictions here = predict(wheels, intervals, numbers);
  std::array<std::array<Predictions, 2>, kNumbers> beside;
  for (int n = 0; n < kNumbers; ++n) {
    const Vector step = kStep * Vector::Unit(n);
    beside[static_cast<std::size_t>(n)] = {predict(wheels, intervals, to_setup(at - step)),
                                           predict(wheels, intervals, to_setup(at + step))};
  }
  std::vector<Residual> out;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const types::Se2& seen = intervals[i].T_from_to;
    Residual r;
    r.interval = i;
    bool covered = here[i].has_value();
    for (std::size_t n = 0; covered && n < kNumbers; ++n) {
      const auto &low = beside[n][0][i], &high = beside[n][1][i];
      covered = low && high;
      if (covered) r.slope.col(static_cast<Eigen::Index>(n)) = wrapped(*high - *low) / (2.0 * kStep);
    }
    if (!covered) continue;
    r.left_over = wrapped(Eigen::Vector3d(seen.x_m, seen.y_m, seen.theta_rad) - *here[i]);
    out.push_back(r);
  }
  return out;
}

void leave_out(std::vector<Residual>& residuals, const Spread& spread, const FitParams& params) {
  for (Residual& r : residuals)
    r.used = r.left_over.head<2>().norm() < params.outlier_sigmas * spread.place_m &&
             std::abs(r.left_over.z()) < params.outlier_sigmas * spread.turn_rad;
}

struct Sums {
  Matrix information = Matrix::Zero();
  Vector gradient = Vector::Zero();
};
Sums sum(const std::vector<Residual>& residuals, const Spread& spread) {
  const Eigen::Vector3d weight(1.0 / (spread.place_m * spread.place_m),
                               1.0 / (spread.place_m * spread.place_m),
                               1.0 / (spread.turn_rad * spread.turn_rad));
  Sums sums;
  for (const Residual& r : residuals) {
    if (!r.used) continue;
    sums.information += r.slope.transpose() * weight.asDiagonal() * r.slope;
    sums.gradient += r.slope.transpose() * weight.asDiagonal() * r.left_over;
  }
  return sums;
}

std::vector<bool> used_intervals(const std::vector<Residual>& residuals, std::size_t intervals) {
  std::vector<bool> use(intervals, false);
  for (const Residual& r : residuals) use[r.interval] = r.used;
  return use;
}

/// How badly turning fits at a delay: over the better part of the intervals, the worst left out of the fit.
double misfit(const WheelTrack& wheels, std::span<const Interval> intervals, double delay_s) {
  std::vector<bool> use(intervals.size(), true);
  const auto all = fit_turning(wheels, intervals, use, delay_s);
  if (!all) return HUGE_VAL;
  const double limit = quantile(all->square, kDelayShare);
  for (std::size_t i = 0; i < use.size(); ++i) use[i] = all->square[i] <= limit;
  const auto best = fit_turning(wheels, intervals, use, delay_s);
  if (!best) return HUGE_VAL;
  double total = 0.0;
  for (const double square : best->square) total += std::isfinite(square) ? square : 0.0;
  return total;
}

double best_delay(const WheelTrack& wheels, std::span<const Interval> intervals, const FitParams& params) {
  double best_s = 0.0, least = HUGE_VAL;
  for (double d = -params.delay_max_s; d <= params.delay_max_s; d += params.delay_step_s) {
    const double value = misfit(wheels, intervals, d);
    if (value < least) {
      least = value;
      best_s = d;
    }
  }
  return best_s;
}

/// The closed form again and again, without what contradicts it.
std::optional<Fit> start(const WheelTrack& wheels, std::span<const Interval> intervals,
                         const FitParams& params) {
  const double delay_s = best_delay(wheels, intervals, params);
  std::vector<bool> use(intervals.size(), true);
  Fit out;
  for (int i = 0; i < params.iterations; ++i) {
    const auto numbers = closed_form(wheels, intervals, use, delay_s);
    if (!numbers) return std::nullopt;
    out.numbers = *numbers;
    out.residuals = linearise(wheels, intervals, out.numbers);
    out.spread = spread_of(out.residuals, params);
    leave_out(out.residuals, out.spread, params);
    const std::vector<bool> next = used_intervals(out.residuals, intervals.size());
    if (next == use) break;
    use = next;
  }
  return out;
}

}  // namespace

Spread spread_of(std::span<const Residual> residuals, const FitParams& params) {
  std::vector<double> places, turns;
  for (const Residual& r : residuals) {
    places.push_back(r.left_over.head<2>().norm());
    turns.push_back(std::abs(r.left_over.z()));
  }
  return {std::max(kPerMedian2 * quantile(std::move(places), 0.5), params.sigma_floor_m),
          std::max(kPerMedian * quantile(std::move(turns), 0.5), params.sigma_floor_rad)};
}

double Fit::left_out() const {
  if (residuals.empty()) return 1.0;
  const auto out =
      std::count_if(residuals.begin(), residuals.end(), [](const Residual& r) { return !r.used; });
  return static_cast<double>(out) / static_cast<double>(residuals.size());
}

std::optional<Fit> fit(const WheelTrack& wheels, std::span<const Interval> intervals, double overlap,
                       const FitParams& params) {
  auto out = start(wheels, intervals, params);
  if (!out) return std::nullopt;
  for (int i = 0; i < params.iterations; ++i) {
    const Sums sums = sum(out->residuals, out->spread);
    const Vector step = sums.information.ldlt().solve(sums.gradient);
    if (!step.allFinite()) return std::nullopt;
    out->numbers = to_setup(to_vector(out->numbers) + step);
    if (!(out->numbers.wheels.track_m > 0.0)) return std::nullopt;
    out->residuals = linearise(wheels, intervals, out->numbers);
    out->spread = spread_of(out->residuals, params);
    leave_out(out->residuals, out->spread, params);
  }
  const Sums sums = sum(out->residuals, out->spread);
  out->covariance = overlap * sums.information.ldlt().solve(Matrix::Identity());
  if (!out->covariance.allFinite() || !(out->covariance.diagonal().minCoeff() > 0.0)) return std::nullopt;
  return out;
}

}  // namespace topo::calibration

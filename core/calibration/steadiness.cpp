// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/steadiness.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace topo::calibration {
namespace {

constexpr int kReweightings = 10;

struct Place {
  Eigen::Vector3d change = Eigen::Vector3d::Zero();  ///< yaw, x, y
  Eigen::Vector3d sigma = Eigen::Vector3d::Constant(HUGE_VAL);
};

/// What is left of a part when the scanner's place has changed.
std::vector<Residual> moved(std::span<const Residual> part, const Eigen::Vector3d& change) {
  std::vector<Residual> out(part.begin(), part.end());
  for (Residual& r : out) r.left_over -= r.slope.middleCols<3>(kYaw) * change;
  return out;
}

/// Robust least squares with a Cauchy kernel over residuals that are already linear in the change. The spread
/// is the part's own: that of a whole with two places is wide enough to hide both.
Place place_in(std::span<const Residual> part, const FitParams& params, double overlap) {
  Place out;
  for (int i = 0; i < kReweightings; ++i) {
    const Spread spread = spread_of(moved(part, out.change), params);
    const Eigen::Vector3d weight(1.0 / (spread.place_m * spread.place_m),
                                 1.0 / (spread.place_m * spread.place_m),
                                 1.0 / (spread.turn_rad * spread.turn_rad));
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Residual& r : part) {
      const Eigen::Matrix3d slope = r.slope.middleCols<3>(kYaw);
      const Eigen::Vector3d left_over = r.left_over - slope * out.change;
      const double square = left_over.dot(weight.cwiseProduct(left_over));
      const Eigen::Vector3d w = weight / (1.0 + square / 9.0);
      information += slope.transpose() * w.asDiagonal() * slope;
      gradient += slope.transpose() * w.asDiagonal() * left_over;
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(information);
    const Eigen::Vector3d step = solver.solve(gradient);
    if (!step.allFinite()) return {};
    out.change += step;
    const Eigen::Vector3d variance = solver.solve(Eigen::Matrix3d::Identity()).diagonal() * overlap;
    if (!variance.allFinite() || !(variance.minCoeff() > 0.0)) return {};
    out.sigma = variance.cwiseSqrt();
  }
  return out;
}

/// How far beyond what is normal; at most 1 is none.
double excess(const Place& place, const SteadinessParams& params) {
  const double place_sigma = std::max(place.sigma[1], place.sigma[2]);
  if (place.sigma[0] > params.sigma_max_rad || place_sigma > params.sigma_max_m) return 0.0;
  const double yaw = std::abs(place.change[0]) / std::max(params.yaw_rad, params.sigmas * place.sigma[0]);
  const double moved = place.change.tail<2>().norm() / std::max(params.place_m, params.sigmas * place_sigma);
  return std::max(yaw, moved);
}

}  // namespace

std::optional<Shift> find_shift(const Fit& fit, std::span<const Interval> intervals, double overlap,
                                const SteadinessParams& params, const FitParams& fit_params) {
  const std::span<const Residual> all(fit.residuals);
  if (all.empty()) return std::nullopt;
  const double start_s = intervals[all.front().interval].from_s;
  std::optional<Shift> worst;
  double most = 1.0;
  for (std::size_t first = 0, last = 0; last < all.size(); first = last) {
    const double from_s = intervals[all[first].interval].from_s;
    while (last < all.size() && intervals[all[last].interval].from_s < from_s + params.window_s) ++last;
    const Place place = place_in(all.subspan(first, last - first), fit_params, overlap);
    const double beyond = excess(place, params);
    if (beyond <= most) continue;
    most = beyond;
    worst = Shift{from_s - start_s, place.change[0], place.change[1], place.change[2]};
  }
  return worst;
}

}  // namespace topo::calibration

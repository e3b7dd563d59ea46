// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/refine.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace topo::slam {
namespace {

/// Sums over all points at one pose.
struct Sums {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double inlier_square = 0.0;
  int inliers = 0;
  int found = 0;
};

void accumulate(Sums& sums, double r, double jx, double jy, double jt, double weight) {
  Eigen::Matrix3d& h = sums.information;
  const double wx = weight * jx, wy = weight * jy, wt = weight * jt;
  h(0, 0) += wx * jx;
  h(0, 1) += wx * jy;
  h(0, 2) += wx * jt;
  h(1, 1) += wy * jy;
  h(1, 2) += wy * jt;
  h(2, 2) += wt * jt;
  sums.gradient += Eigen::Vector3d(wx, wy, wt) * r;
}

Sums linearise(const SurfelMap& map, std::span<const Point> points, const Point& sensor,
               const types::Se2& pose, const RefineParams& params) {
  Sums sums;
  const auto c = static_cast<float>(std::cos(pose.theta_rad)),
             s = static_cast<float>(std::sin(pose.theta_rad));
  const Point t = pose.translation().cast<float>();
  const Point sensor_map(c * sensor.x() - s * sensor.y() + t.x(), s * sensor.x() + c * sensor.y() + t.y());
  const double kernel2 = params.kernel_m * params.kernel_m;
  const auto reach2 = static_cast<float>(params.reach_m * params.reach_m);
  const double unit = 1.0 / (params.point_sigma_m * params.point_sigma_m);
  for (const Point& p : points) {
    const Point arm(c * p.x() - s * p.y(), s * p.x() + c * p.y());
    const Point q = arm + t;
    const Surfel* surfel = map.nearest(q);
    if (surfel == nullptr) continue;
    const Point delta = q - surfel->position;
    if (delta.squaredNorm() > reach2) continue;
    // A planar surfel that faces away from the sensor is the other face of a thin wall: another surface.
    if (surfel->planar && surfel->normal.dot(sensor_map - q) < 0.0F) continue;
    ++sums.found;
    const double ax = static_cast<double>(arm.x()), ay = static_cast<double>(arm.y());
    const auto nx = static_cast<double>(surfel->normal.x()), ny = static_cast<double>(surfel->normal.y());
    const auto dx = static_cast<double>(delta.x()), dy = static_cast<double>(delta.y());
    const double r = surfel->planar ? nx * dx + ny * dy : std::hypot(dx, dy);
    const double weight = unit / (1.0 + r * r / kernel2);
    if (std::abs(r) < params.inlier_m) {
      ++sums.inliers;
      sums.inlier_square += r * r;
    }
    if (surfel->planar) {
      accumulate(sums, r, nx, ny, ny * ax - nx * ay, weight);
    } else {
      accumulate(sums, dx, 1.0, 0.0, -ay, params.point_weight * weight);
      accumulate(sums, dy, 0.0, 1.0, ax, params.point_weight * weight);
    }
  }
  sums.information(1, 0) = sums.information(0, 1);
  sums.information(2, 0) = sums.information(0, 2);
  sums.information(2, 1) = sums.information(1, 2);
  return sums;
}

/// True when, with the rotation eliminated, one direction of translation is not determined.
bool is_degenerate(const Eigen::Matrix3d& h, const RefineParams& params) {
  if (!(h(2, 2) > 0.0)) return true;
  const Eigen::Matrix2d schur =
      h.topLeftCorner<2, 2>() - h.topRightCorner<2, 1>() * h.bottomLeftCorner<1, 2>() / h(2, 2);
  const double half_trace = 0.5 * schur.trace();
  const double root = std::sqrt(std::max(0.0, half_trace * half_trace - schur.determinant()));
  return half_trace - root < params.degenerate_ratio * (half_trace + root);
}

Match report(const Sums& sums, std::size_t points, const types::Se2& pose, const RefineParams& params) {
  Match match;
  match.T_map_base = pose;
  const double count = std::max<double>(1.0, static_cast<double>(points));
  match.response = sums.inliers / count;
  match.overlap = sums.found / count;
  match.rms_m = sums.inliers > 0 ? std::sqrt(sums.inlier_square / sums.inliers) : 0.0;
  match.scan_information = sums.information;
  match.degenerate = is_degenerate(sums.information, params);
  return match;
}

}  // namespace

Match evaluate(const SurfelMap& map, std::span<const Point> points, const Point& sensor,
               const types::Se2& pose, const RefineParams& params) {
  return report(linearise(map, points, sensor, pose, params), points.size(), pose, params);
}

Match refine(const SurfelMap& map, std::span<const Point> points, const Point& sensor,
             const types::Se2& start, const std::optional<Prior>& prior, const RefineParams& params) {
  types::Se2 pose = start;
  int iteration = 0;
  while (iteration < params.iterations_max) {
    ++iteration;
    const Sums sums = linearise(map, points, sensor, pose, params);
    Eigen::Matrix3d h = sums.information;
    Eigen::Vector3d g = sums.gradient;
    if (prior) {
      const types::Se2& mean = prior->T_map_base;
      const Eigen::Vector3d e(pose.x_m - mean.x_m, pose.y_m - mean.y_m,
                              types::wrap_angle(pose.theta_rad - mean.theta_rad));
      h += prior->information;
      g += prior->information * e;
    }
    // Keeps the step finite in directions that neither scan nor prior determines.
    h.diagonal().array() += 1e-3;
    const Eigen::Vector3d step = h.ldlt().solve(-g);
    if (!step.allFinite()) break;
    pose = {pose.x_m + step.x(), pose.y_m + step.y(), types::wrap_angle(pose.theta_rad + step.z())};
    if (step.head<2>().norm() < params.converged_m && std::abs(step.z()) < params.converged_rad) break;
  }
  Match match = evaluate(map, points, sensor, pose, params);
  match.iterations = iteration;
  return match;
}

}  // namespace topo::slam

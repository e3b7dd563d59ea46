// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/breadcrumb_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/types/invariant.hpp"

namespace topo::motion {
namespace {

using types::Se2;
using types::Vector2;

constexpr double kRounding_m = 1e-3;  // numerical: of odometry in whole millimetres

/// Angle from straight behind the robot to a point. Of the point opposite, since the difference of a bearing
/// and pi is rounded differently on the two sides of the robot.
double aside_rad(const Vector2& p_base) { return std::atan2(-p_base.y(), -p_base.x()); }

}  // namespace

void BreadcrumbPath::push(const Vector2& p) {
  if (size_ == kCapacity) drop_oldest();
  points_[size_++] = p;
  while (size_ > 2 && length_m() - (points_[1] - points_[0]).norm() >= params_.length_m) drop_oldest();
}

void BreadcrumbPath::drop_oldest() {
  std::copy(points_.begin() + 1, points_.begin() + static_cast<std::ptrdiff_t>(size_), points_.begin());
  --size_;
}

void BreadcrumbPath::update(const Se2& T_odom_base) {
  const Vector2 p = T_odom_base.translation();
  if (size_ > 0 && !((p - pose_.translation()).norm() <= params_.jump_m)) size_ = 0;
  pose_ = T_odom_base;
  if (size_ == 0) {
    push(p);
    return;
  }
  const Vector2 step = p - points_[size_ - 1];
  const bool backwards = step.x() * std::cos(pose_.theta_rad) + step.y() * std::sin(pose_.theta_rad) < 0.0;
  if (!backwards) {
    if (step.norm() >= params_.spacing_m) push(p);
    return;
  }
  while (size_ > 1 &&
         (p - points_[size_ - 2]).norm() <= (points_[size_ - 1] - points_[size_ - 2]).norm() + kRounding_m)
    --size_;
}

double BreadcrumbPath::length_m() const {
  if (size_ == 0) return 0.0;
  double length = (pose_.translation() - points_[size_ - 1]).norm();
  for (std::size_t i = size_ - 1; i > 0; --i) length += (points_[i] - points_[i - 1]).norm();
  return length;
}

double BreadcrumbPath::behind_m() const {
  double behind_m = 0.0;
  for (std::size_t i = size_; i > 0; --i) {
    const Vector2 p_base = pose_.inverse() * points_[i - 1];
    if (std::abs(p_base.y()) > params_.beside_m && std::abs(aside_rad(p_base)) > params_.behind_rad) break;
    behind_m = std::max(behind_m, -p_base.x());
  }
  return behind_m;
}

Vector2 BreadcrumbPath::point_base(double away_m) const {
  types::require(size_ > 0, "motion::BreadcrumbPath: no point to aim at");
  std::size_t i = size_ - 1;
  while (i > 0 && (points_[i] - pose_.translation()).norm() < away_m) --i;
  return pose_.inverse() * points_[i];
}

/// The path has a corner where the robot turned on the spot: a nearer point may lie behind when a farther one
/// does not.
Vector2 BreadcrumbPath::target_base() const {
  for (const double aim_m : params_.aims_m) {
    Vector2 target = point_base(aim_m);
    if (std::abs(aside_rad(target)) <= params_.behind_rad) return target;
  }
  return point_base(params_.aims_m.front());
}

double BreadcrumbPath::turn_to_back_rad() const {
  if (size_ == 0) return 0.0;
  const Vector2 target = target_base();
  return target.norm() < params_.spacing_m ? 0.0 : aside_rad(target);
}

types::Twist2 BreadcrumbPath::back_twist(double speed_mps) const {
  if (size_ < 2) return {};
  const Vector2 target = target_base();
  if (target.norm() < params_.spacing_m || std::abs(turn_to_back_rad()) > params_.behind_rad) return {};
  if ((points_[size_ - 1] - pose_.translation()).norm() > params_.off_m) return {};
  return {-speed_mps, -speed_mps * 2.0 * target.y() / target.squaredNorm()};
}

}  // namespace topo::motion

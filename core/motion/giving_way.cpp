// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/giving_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/perception/footprint_sweep.hpp"

namespace topo::motion {
namespace {

using types::Twist2;
using types::Vector2;

constexpr double kStep_s = 0.05;  // of the integration: 3.5 cm at 0.7 m/s

/// Poses of the base, step by step, when it drives on for a while and then brakes on the same arc.
class Course {
 public:
  Course(const Twist2& twist, double alive_s, double braking_s, double until_s)
      : twist_(twist), alive_s_(alive_s), braking_s_(braking_s), until_s_(until_s) {
    while (size_ < kMostSteps && static_cast<double>(size_ + 1) * kStep_s < until_s) {
      ++size_;
      steps_[size_ - 1] = step(at_s(size_ - 1));
    }
  }
  [[nodiscard]] const Twist2& twist() const { return twist_; }
  [[nodiscard]] double until_s() const { return until_s_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Time of a step, from now.
  [[nodiscard]] static double at_s(std::size_t i) { return static_cast<double>(i + 1) * kStep_s; }
  /// A point of the current base frame, in the base frame at a step.
  [[nodiscard]] Vector2 seen(std::size_t i, const Vector2& p) const {
    const Step& s = steps_[i];
    const Vector2 off = p - s.at;
    return {s.cosine * off.x() + s.sine * off.y(), s.cosine * off.y() - s.sine * off.x()};
  }

 private:
  static constexpr std::size_t kMostSteps = 128;  // size of an array: 6.4 s
  struct Step {
    Vector2 at{0.0, 0.0};
    double cosine = 1.0, sine = 0.0;
  };
  [[nodiscard]] Step step(double t_s) const {
    const double brakes_s = std::clamp(t_s - alive_s_, 0.0, braking_s_);
    double driven_s = std::min(t_s, alive_s_) + brakes_s;
    if (braking_s_ > 0.0) driven_s -= brakes_s * brakes_s / (2.0 * braking_s_);
    const double turn = twist_.omega_radps * driven_s, half = 0.5 * turn, way = twist_.v_mps * driven_s;
    const double chord = std::abs(half) < 1e-6 ? way : way * std::sin(half) / half;
    return {{chord * std::cos(half), chord * std::sin(half)}, std::cos(turn), std::sin(turn)};
  }

  Twist2 twist_;
  double alive_s_, braking_s_, until_s_;
  std::array<Step, kMostSteps> steps_{};
  std::size_t size_ = 0;
};

double braking_s(const Twist2& twist, const types::RobotLimits& l, double share) {
  return std::max(std::abs(twist.v_mps) / (share * l.deceleration_mps2),
                  std::abs(twist.omega_radps) / (share * l.angular_acceleration_radps2));
}

/// True when the obstacle and the robot can meet before the course ends.
bool is_in_reach(const perception::MovingObstacle& one, const Course& course, double margin_m,
                 const types::Footprint& footprint, const GivingWayParams& params) {
  const double closing_mps = one.velocity_mps.norm() + std::abs(course.twist().v_mps) + params.unsure_mps;
  const double far_m = closing_mps * course.until_s() + margin_m + one.radius_m + types::reach_m(footprint);
  return one.centre.squaredNorm() < far_m * far_m;
}

bool is_clear(const Course& course, const perception::MovingObstacle& one, double margin_m,
              const types::Footprint& footprint, const GivingWayParams& params) {
  if (!is_in_reach(one, course, margin_m, footprint, params)) return true;
  const double now_m = perception::distance_m(one.centre, footprint) - one.radius_m - params.nearer_m;
  for (std::size_t i = 0; i < course.size(); ++i) {
    const double t_s = Course::at_s(i);
    const double keep_m = std::min(margin_m + params.unsure_mps * t_s, now_m);
    const Vector2 then = course.seen(i, one.centre + t_s * one.velocity_mps);
    if (perception::distance_m(then, footprint) - one.radius_m < keep_m) return false;
  }
  return true;
}

bool is_clear(const Course& course, std::span<const perception::MovingObstacle> moving, double margin_m,
              const types::Footprint& footprint, const GivingWayParams& params) {
  return std::all_of(moving.begin(), moving.end(), [&](const perception::MovingObstacle& one) {
    return is_clear(course, one, margin_m, footprint, params);
  });
}

bool gives_way(const Twist2& twist, std::span<const perception::MovingObstacle> moving, double alive_s,
               const types::RobotLimits& l, const GivingWayParams& params) {
  const double brakes_s = braking_s(twist, l, params.braking_share);
  const double until_s = alive_s + brakes_s + params.clear_for_s;
  if (is_clear(Course(twist, alive_s, brakes_s, until_s), moving, l.margin_m, l.footprint, params))
    return true;
  return stands_in_time(twist, moving, alive_s, l.margin_m, l, params) &&
         is_clear(Course(twist, until_s, 0.0, until_s), moving, l.margin_m, l.footprint, params);
}

}  // namespace

bool stands_in_time(const Twist2& twist, std::span<const perception::MovingObstacle> moving, double alive_s,
                    double margin_m, const types::RobotLimits& limits, const GivingWayParams& params) {
  if (moving.empty()) return true;
  const double brakes_s = braking_s(twist, limits, params.braking_share);
  return is_clear(Course(twist, alive_s, brakes_s, alive_s + brakes_s), moving, margin_m, limits.footprint,
                  params);
}

double giving_way_scale(const Twist2& twist, std::span<const perception::MovingObstacle> moving,
                        double alive_s, const types::RobotLimits& limits, const GivingWayParams& params) {
  constexpr int kParts = 20;  // resolution of the search
  if (moving.empty()) return 1.0;
  for (int part = kParts; part > 0; --part) {
    const double scale = static_cast<double>(part) / kParts;
    if (gives_way({scale * twist.v_mps, scale * twist.omega_radps}, moving, alive_s, limits, params))
      return scale;
  }
  return 0.0;
}

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/giving_way.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/footprint_sweep.hpp"

namespace topo::motion {
namespace {

using types::Se2;
using types::Twist2;
using types::Vector2;

constexpr double kStep_s = 0.05;
constexpr double kReserve = 0.8;     // of the deceleration: the next periods have to keep to it as well
constexpr double kUnsure_mps = 0.1;  // of a velocity, of how a person goes on
constexpr double kClearFor_s = 1.0;

/// Driving on for a while, then braking on the same arc; or driving on for good.
class Course {
 public:
  Course(const Twist2& twist, double alive_s, double braking_s)
      : twist_(twist), alive_s_(alive_s), braking_s_(braking_s) {}
  [[nodiscard]] double stands_s() const { return alive_s_ + braking_s_; }
  [[nodiscard]] Se2 at(double t_s) const {
    const double brakes_s = std::clamp(t_s - alive_s_, 0.0, braking_s_);
    double driven_s = std::min(t_s, alive_s_) + brakes_s;
    if (braking_s_ > 0.0) driven_s -= brakes_s * brakes_s / (2.0 * braking_s_);
    const double turn = twist_.omega_radps * driven_s, half = 0.5 * turn, way = twist_.v_mps * driven_s;
    const double chord = std::abs(half) < 1e-6 ? way : way * std::sin(half) / half;
    return {chord * std::cos(half), chord * std::sin(half), turn};
  }

 private:
  Twist2 twist_;
  double alive_s_, braking_s_;
};

double braking_s(const Twist2& twist, const RobotLimits& l) {
  return std::max(std::abs(twist.v_mps) / (kReserve * l.deceleration_mps2),
                  std::abs(twist.omega_radps) / (kReserve * l.angular_acceleration_radps2));
}

double gap_m(const MovingObstacle& one, double t_s, const Se2& T_now_base, const Footprint& footprint) {
  const Vector2 centre = one.centre + t_s * one.velocity_mps;
  return distance_m(T_now_base.inverse() * centre, footprint) - one.radius_m;
}

/// Can they meet at all until then?
bool is_in_reach(const MovingObstacle& one, const Twist2& twist, double until_s, double margin_m,
                 const Footprint& footprint) {
  const double far_m = (one.velocity_mps.norm() + std::abs(twist.v_mps) + kUnsure_mps) * until_s + margin_m +
                       one.radius_m + reach_m(footprint);
  return one.centre.squaredNorm() < far_m * far_m;
}

bool is_clear(const Course& course, const Twist2& twist, const MovingObstacle& one, double until_s,
              double margin_m, const Footprint& footprint) {
  constexpr double kNearer_m = 0.01;
  if (!is_in_reach(one, twist, until_s, margin_m, footprint)) return true;
  const double now_m = gap_m(one, 0.0, {}, footprint) - kNearer_m;
  for (double t_s = kStep_s; t_s < until_s; t_s += kStep_s) {
    const double keep_m = std::min(margin_m + kUnsure_mps * t_s, now_m);
    if (gap_m(one, t_s, course.at(t_s), footprint) < keep_m) return false;
  }
  return true;
}

bool gives_way(const Twist2& twist, std::span<const MovingObstacle> moving, double alive_s,
               const RobotLimits& limits) {
  const Course brakes(twist, alive_s, braking_s(twist, limits));
  const double until_s = brakes.stands_s() + kClearFor_s;
  const Course goes_on(twist, until_s, 0.0);
  const auto clear = [&](const Course& course, double time_s) {
    return std::all_of(moving.begin(), moving.end(), [&](const MovingObstacle& one) {
      return is_clear(course, twist, one, time_s, limits.margin_m, limits.footprint);
    });
  };
  return clear(brakes, until_s) || (clear(brakes, brakes.stands_s()) && clear(goes_on, until_s));
}

}  // namespace

bool stands_in_time(const Twist2& twist, std::span<const MovingObstacle> moving, double alive_s,
                    double margin_m, const RobotLimits& limits) {
  const Course brakes(twist, alive_s, braking_s(twist, limits));
  return std::all_of(moving.begin(), moving.end(), [&](const MovingObstacle& one) {
    return is_clear(brakes, twist, one, brakes.stands_s(), margin_m, limits.footprint);
  });
}

double giving_way_scale(const Twist2& twist, std::span<const MovingObstacle> moving, double alive_s,
                        const RobotLimits& limits) {
  constexpr int kParts = 20;
  if (moving.empty()) return 1.0;
  for (int part = kParts; part > 0; --part) {
    const double scale = static_cast<double>(part) / kParts;
    if (gives_way({scale * twist.v_mps, scale * twist.omega_radps}, moving, alive_s, limits)) return scale;
  }
  return 0.0;
}

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/footprint_sweep.hpp"

#include <algorithm>
#include <numbers>

namespace topo::motion {
namespace {

using types::Twist2;
using types::Vector2;

constexpr double kStraight_radps = 1e-6;

double straight_contact_s(const Vector2& p, double v_mps, const Footprint& f) {
  if (std::abs(p.y()) > f.half_width_m || v_mps == 0.0) return kNever_s;
  const double gap_m = v_mps > 0.0 ? p.x() - f.front_m : -f.rear_m - p.x();
  return gap_m < 0.0 ? kNever_s : gap_m / std::abs(v_mps);
}

/// Seen from the robot, the world turns about the centre of its arc, at (0, radius_m): a point keeps its
/// distance rho from there, and meets the footprint where that circle crosses one of the four sides.
class Arc {
 public:
  Arc(const Vector2& p, const Twist2& twist, const Footprint& f)
      : radius_m_(twist.v_mps / twist.omega_radps),
        rho_m_(std::hypot(p.x(), p.y() - radius_m_)),
        angle_rad_(std::atan2(p.y() - radius_m_, p.x())),
        omega_radps_(twist.omega_radps),
        footprint_(f) {}

  [[nodiscard]] double contact_s() {
    cross_side_at_x(footprint_.front_m);
    cross_side_at_x(-footprint_.rear_m);
    cross_side_at_y(footprint_.half_width_m);
    cross_side_at_y(-footprint_.half_width_m);
    return first_s_;
  }

 private:
  void cross_side_at_x(double x_m) {
    const double square = rho_m_ * rho_m_ - x_m * x_m;
    if (square < 0.0) return;
    for (const double y_m : {std::sqrt(square), -std::sqrt(square)})
      if (std::abs(y_m + radius_m_) <= footprint_.half_width_m) meet(x_m, y_m);
  }
  void cross_side_at_y(double side_m) {
    const double y_m = side_m - radius_m_;
    const double square = rho_m_ * rho_m_ - y_m * y_m;
    if (square < 0.0) return;
    for (const double x_m : {std::sqrt(square), -std::sqrt(square)})
      if (x_m <= footprint_.front_m && x_m >= -footprint_.rear_m) meet(x_m, y_m);
  }
  void meet(double x_m, double y_m) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double turned = (angle_rad_ - std::atan2(y_m, x_m)) * (omega_radps_ > 0.0 ? 1.0 : -1.0);
    const double way_rad = turned - kTurn * std::floor(turned / kTurn);  // in [0, 2 pi)
    first_s_ = std::min(first_s_, way_rad / std::abs(omega_radps_));
  }

  double radius_m_, rho_m_, angle_rad_, omega_radps_;
  Footprint footprint_;
  double first_s_ = kNever_s;
};

Vector2 nearest_in(const Footprint& f, const Vector2& p) {
  return {std::clamp(p.x(), -f.rear_m, f.front_m), std::clamp(p.y(), -f.half_width_m, f.half_width_m)};
}

/// Whether the gap to the footprint closes at more than a fifth of the point's relative speed.
bool approaches(const Vector2& p, const Twist2& twist, const Footprint& f) {
  constexpr double kClosing = 0.2;
  const Vector2 gap = p - nearest_in(f, p);
  const Vector2 velocity{-twist.v_mps + twist.omega_radps * p.y(), -twist.omega_radps * p.x()};
  return gap.dot(velocity) < -kClosing * gap.norm() * velocity.norm();
}

}  // namespace

bool contains(const Footprint& f, const Vector2& p) {
  return p.x() <= f.front_m && p.x() >= -f.rear_m && std::abs(p.y()) <= f.half_width_m;
}

double contact_time_s(const Vector2& p, const Twist2& twist, const Footprint& f) {
  if (contains(f, p)) return 0.0;
  if (std::abs(twist.omega_radps) < kStraight_radps) return straight_contact_s(p, twist.v_mps, f);
  return Arc(p, twist, f).contact_s();
}

double contact_time_with_margin_s(const Vector2& p, const Twist2& twist, const Footprint& f,
                                  double margin_m) {
  const Footprint wide = grown(f, margin_m);
  if (!contains(wide, p)) return contact_time_s(p, twist, wide);
  return approaches(p, twist, f) ? 0.0 : contact_time_s(p, twist, f);
}

}  // namespace topo::motion

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/footprint_sweep.hpp"

#include <algorithm>
#include <numbers>

namespace topo::perception {
namespace {

using types::Twist2;
using types::Vector2;

constexpr double kStraight_radps = 1e-6;  // numerical: a slower turn is a straight line to the rounding

double straight_contact_s(const Vector2& p, double v_mps, const types::Footprint& f) {
  if (std::abs(p.y()) > std::min(f.half_width_m, f.swing_radius_m) || v_mps == 0.0) return kNever_s;
  const double on_circle_m = std::sqrt(f.swing_radius_m * f.swing_radius_m - p.y() * p.y());
  const double front_m = std::min(f.front_m, on_circle_m), rear_m = std::min(f.rear_m, on_circle_m);
  const double gap_m = v_mps > 0.0 ? p.x() - front_m : -rear_m - p.x();
  return gap_m < 0.0 ? kNever_s : gap_m / std::abs(v_mps);
}

/// In the robot's frame the world turns about the centre of the robot's arc, at (0, radius_m). A point keeps
/// its distance rho from that centre and meets the footprint where its circle crosses one of the four sides
/// or the circle that cuts the corners.
class Arc {
 public:
  Arc(const Vector2& p, const Twist2& twist, const types::Footprint& f)
      : radius_m_(twist.v_mps / twist.omega_radps),
        from_centre_(p.x(), p.y() - radius_m_),
        rho2_m2_(from_centre_.squaredNorm()),
        omega_radps_(twist.omega_radps),
        footprint_(f) {}

  [[nodiscard]] double contact_s() {
    if (is_off_the_ring()) return kNever_s;
    cross_side_at_x(footprint_.front_m);
    cross_side_at_x(-footprint_.rear_m);
    cross_side_at_y(footprint_.half_width_m);
    cross_side_at_y(-footprint_.half_width_m);
    cross_swing_circle();
    return first_s_;
  }

 private:
  /// True when the point lies within or outside the ring that the footprint sweeps around the arc's centre,
  /// as most near points do.
  [[nodiscard]] bool is_off_the_ring() const {
    constexpr double kRounding_m = 1e-6;  // numerical: a rejected point must not touch
    const double centre_m = std::abs(radius_m_);
    const double end_m = std::max(footprint_.front_m, footprint_.rear_m);
    const double corner_m = std::sqrt(end_m * end_m + footprint_.half_width_m * footprint_.half_width_m);
    const double outer_m = centre_m + std::min(corner_m, footprint_.swing_radius_m) + kRounding_m;
    const double inner_m = std::max(0.0, centre_m - footprint_.half_width_m - kRounding_m);
    return rho2_m2_ > outer_m * outer_m || rho2_m2_ < inner_m * inner_m;
  }
  void cross_side_at_x(double x_m) {
    const double square = rho2_m2_ - x_m * x_m;
    if (square < 0.0) return;
    for (const double y_m : {std::sqrt(square), -std::sqrt(square)})
      if (std::abs(y_m + radius_m_) <= footprint_.half_width_m && in_circle(x_m, y_m)) meet(x_m, y_m);
  }
  void cross_side_at_y(double side_m) {
    const double y_m = side_m - radius_m_;
    const double square = rho2_m2_ - y_m * y_m;
    if (square < 0.0) return;
    for (const double x_m : {std::sqrt(square), -std::sqrt(square)})
      if (x_m <= footprint_.front_m && x_m >= -footprint_.rear_m && in_circle(x_m, y_m)) meet(x_m, y_m);
  }
  void cross_swing_circle() {
    const double swing_m = footprint_.swing_radius_m;
    if (!std::isfinite(swing_m) || radius_m_ == 0.0) return;
    const double from_base_m = (swing_m * swing_m + radius_m_ * radius_m_ - rho2_m2_) / (2.0 * radius_m_);
    const double square = swing_m * swing_m - from_base_m * from_base_m;
    if (square < 0.0 || std::abs(from_base_m) > footprint_.half_width_m) return;
    for (const double x_m : {std::sqrt(square), -std::sqrt(square)})
      if (x_m <= footprint_.front_m && x_m >= -footprint_.rear_m) meet(x_m, from_base_m - radius_m_);
  }
  /// `y_m` is relative to the centre of the arc.
  [[nodiscard]] bool in_circle(double x_m, double y_m) const {
    const double from_base_m = y_m + radius_m_;
    return x_m * x_m + from_base_m * from_base_m <= footprint_.swing_radius_m * footprint_.swing_radius_m;
  }
  void meet(double x_m, double y_m) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double ahead_rad = std::atan2(x_m * from_centre_.y() - y_m * from_centre_.x(),
                                        x_m * from_centre_.x() + y_m * from_centre_.y());
    const double turned = ahead_rad * (omega_radps_ > 0.0 ? 1.0 : -1.0);
    const double way_rad = turned - kTurn * std::floor(turned / kTurn);  // in [0, 2 pi)
    first_s_ = std::min(first_s_, way_rad / std::abs(omega_radps_));
  }

  double radius_m_;
  Vector2 from_centre_;
  double rho2_m2_, omega_radps_;
  types::Footprint footprint_;
  double first_s_ = kNever_s;
};

/// Nearest point of the outline: on the rectangle, on the circle, or where they intersect.
Vector2 nearest_in(const types::Footprint& f, const Vector2& p) {
  Vector2 in_box{std::clamp(p.x(), -f.rear_m, f.front_m), std::clamp(p.y(), -f.half_width_m, f.half_width_m)};
  const double swing_m = f.swing_radius_m;
  if (in_box.norm() <= swing_m) return in_box;
  Vector2 on_circle = p.normalized() * swing_m;
  if (on_circle.x() <= f.front_m && on_circle.x() >= -f.rear_m && std::abs(on_circle.y()) <= f.half_width_m)
    return on_circle;
  const auto other_m = [swing_m](double side_m) {
    return std::sqrt(std::max(0.0, swing_m * swing_m - side_m * side_m));
  };
  const double end_m = p.x() > 0.0 ? std::min(f.front_m, swing_m) : std::min(f.rear_m, swing_m);
  const Vector2 at_end{std::copysign(end_m, p.x()), std::copysign(other_m(end_m), p.y())};
  const Vector2 at_side{std::copysign(other_m(f.half_width_m), p.x()), std::copysign(f.half_width_m, p.y())};
  const bool end_reaches = std::abs(at_end.y()) <= f.half_width_m;
  return end_reaches && (p - at_end).norm() < (p - at_side).norm() ? at_end : at_side;
}

/// True when the gap to the footprint closes at more than `part` of the point's relative speed.
bool approaches(const Vector2& p, const Twist2& twist, const types::Footprint& f, double part) {
  const Vector2 gap = p - nearest_in(f, p);
  const Vector2 velocity{-twist.v_mps + twist.omega_radps * p.y(), -twist.omega_radps * p.x()};
  return gap.dot(velocity) < -part * gap.norm() * velocity.norm();
}

/// Contact time for a point just within the outline, where noise puts a point next to the robot. A motion
/// that does not approach the point may continue.
double contact_time_at_rim_s(const Vector2& p, const Twist2& twist, const types::Footprint& f,
                             double noise_m) {
  constexpr double kNotAtAll = 1e-9;  // numerical: zero, to the rounding
  const types::Footprint slim = types::grown(f, -noise_m);
  if (contains(slim, p) || approaches(p, twist, slim, kNotAtAll)) return 0.0;
  return contact_time_s(p, twist, slim);
}

}  // namespace

bool contains(const types::Footprint& f, const Vector2& p) {
  return p.x() <= f.front_m && p.x() >= -f.rear_m && std::abs(p.y()) <= f.half_width_m &&
         p.squaredNorm() <= f.swing_radius_m * f.swing_radius_m;
}

double distance_m(const Vector2& p, const types::Footprint& f) {
  return contains(f, p) ? 0.0 : (p - nearest_in(f, p)).norm();
}

double contact_time_s(const Vector2& p, const Twist2& twist, const types::Footprint& f) {
  if (contains(f, p)) return 0.0;
  if (std::abs(twist.omega_radps) < kStraight_radps) return straight_contact_s(p, twist.v_mps, f);
  return Arc(p, twist, f).contact_s();
}

double contact_time_with_margin_s(const Vector2& p, const Twist2& twist, const types::Footprint& f,
                                  double margin_m, const ContactParams& params) {
  const types::Footprint wide = types::grown(f, margin_m);
  if (!contains(wide, p)) return contact_time_s(p, twist, wide);
  if (contains(f, p)) return contact_time_at_rim_s(p, twist, f, params.noise_m);
  return approaches(p, twist, f, params.closing_share) ? 0.0 : contact_time_s(p, twist, f);
}

}  // namespace topo::perception

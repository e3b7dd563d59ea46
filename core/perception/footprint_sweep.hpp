// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/perception/params.hpp"
#include "core/types/robot_limits.hpp"
#include "core/types/transform.hpp"

namespace topo::perception {

inline constexpr double kNever_s = HUGE_VAL;

/// Seconds until a footprint that moves at a constant twist, on a straight line or an arc, first touches a
/// point; 0 for a point inside, kNever_s when it does not touch the point within one full turn.
double contact_time_s(const types::Vector2& p_base, const types::Twist2& twist,
                      const types::Footprint& footprint);

/// The same with a margin. A point already within the margin stops a motion towards it. For a motion along it
/// or away from it, only contact with the footprint itself counts, so that a robot beside a wall can leave.
double contact_time_with_margin_s(const types::Vector2& p_base, const types::Twist2& twist,
                                  const types::Footprint& footprint, double margin_m,
                                  const ContactParams& params);

/// First contact of one motion with any of many points. Most points are rejected by their distance: the
/// robot's centre moves at |v|, so a point farther away than the path until the first known contact plus the
/// footprint's reach cannot be touched sooner.
class FirstContact {
 public:
  /// `reach_m`: reach of the footprint with its margin. Contacts after `until_s` are ignored.
  FirstContact(const types::Twist2& twist, double reach_m, double until_s = kNever_s)
      : speed_mps_(std::abs(twist.v_mps)), reach_m_(reach_m), first_s_(until_s) {
    look_as_far_as_needed();
  }
  /// `contact_s()` returns when the motion touches p_base; it is called only when it can matter.
  template <class Contact>
  void offer(const types::Vector2& p_base, Contact contact_s) {
    if (p_base.squaredNorm() > square_m2_) return;
    const double at_s = contact_s();
    if (!(at_s < first_s_)) return;
    first_s_ = at_s;
    look_as_far_as_needed();
  }
  /// The first contact, or until_s.
  [[nodiscard]] double seconds() const { return first_s_; }

 private:
  void look_as_far_as_needed() {
    constexpr double kRounding_m = 1e-6;  // numerical: a rejected point must not touch
    const double way_m = speed_mps_ > 0.0 ? speed_mps_ * first_s_ : 0.0;
    const double far_m = reach_m_ + way_m + kRounding_m;
    square_m2_ = far_m * far_m;
  }

  double speed_mps_, reach_m_, first_s_;
  double square_m2_ = kNever_s;
};

bool contains(const types::Footprint& footprint, const types::Vector2& p_base);
/// Distance from the outline to a point outside; 0 inside.
double distance_m(const types::Vector2& p_base, const types::Footprint& footprint);

}  // namespace topo::perception

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/robot_limits.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/unit/core/motion/generators.hpp"

namespace topo::types {
namespace {

using motion::uniform;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A value of the limits, and whether 0 is in its range.
struct Value {
  const char* name;
  double& (*of)(RobotLimits&);
  bool may_be_zero = false;
};

const std::vector<Value>& limit_values() {
  static const std::vector<Value> kValues{
      {"v_max", [](RobotLimits& l) -> double& { return l.v_max_mps; }},
      {"omega_max", [](RobotLimits& l) -> double& { return l.omega_max_radps; }},
      {"acceleration", [](RobotLimits& l) -> double& { return l.acceleration_mps2; }},
      {"deceleration", [](RobotLimits& l) -> double& { return l.deceleration_mps2; }},
      {"angular", [](RobotLimits& l) -> double& { return l.angular_acceleration_radps2; }},
      {"front", [](RobotLimits& l) -> double& { return l.footprint.front_m; }},
      {"rear", [](RobotLimits& l) -> double& { return l.footprint.rear_m; }},
      {"half width", [](RobotLimits& l) -> double& { return l.footprint.half_width_m; }},
      {"v_beside", [](RobotLimits& l) -> double& { return l.v_beside_mps; }},
      {"slip aside", [](RobotLimits& l) -> double& { return l.slip_aside_m_per_rad; }},
      {"omega_beside", [](RobotLimits& l) -> double& { return l.omega_beside_radps; }},
      {"v_reverse", [](RobotLimits& l) -> double& { return l.v_reverse_max_mps; }},
      {"slip curvature", [](RobotLimits& l) -> double& { return l.slip_curvature_per_m; }, true},
      {"margin", [](RobotLimits& l) -> double& { return l.margin_m; }, true},
      {"turn margin", [](RobotLimits& l) -> double& { return l.turn_margin_m; }, true},
  };
  return kValues;
}

TEST(RobotLimits, EachValueMustBeFiniteAndInItsRange) {
  ASSERT_TRUE(is_valid(RobotLimits{}));
  for (const Value& value : limit_values()) {
    const auto is_valid_with = [&](double number) {
      RobotLimits limits;
      value.of(limits) = number;
      return is_valid(limits);
    };
    EXPECT_TRUE(is_valid_with(0.01)) << value.name;
    EXPECT_EQ(is_valid_with(0.0), value.may_be_zero) << value.name;
    for (const double bad : {-0.01, kNaN, HUGE_VAL, -HUGE_VAL})
      EXPECT_FALSE(is_valid_with(bad)) << value.name << " " << bad;
  }
}

TEST(RobotLimits, TheSwingRadiusIsAtLeastHalfTheWidth) {
  RobotLimits limits;
  const double half_m = limits.footprint.half_width_m;
  for (const double good : {half_m, half_m + 0.1, HUGE_VAL}) {
    limits.footprint.swing_radius_m = good;
    EXPECT_TRUE(is_valid(limits)) << good;
  }
  for (const double bad : {half_m - 1e-6, 0.0, -1.0, kNaN}) {
    limits.footprint.swing_radius_m = bad;
    EXPECT_FALSE(is_valid(limits)) << bad;
  }
}

TEST(RobotLimits, TheReactionIsNotNegative) {
  RobotLimits limits;
  limits.reaction = Duration::zero();
  EXPECT_TRUE(is_valid(limits));
  limits.reaction = Duration(-1);
  EXPECT_FALSE(is_valid(limits));
}

TEST(RobotLimits, TheModelsOfTheCatalogueAreValid) {
  for (const ModelSize& model : {kP3dx, kP3at}) {
    RobotLimits limits;
    limits.footprint = {model.front_m, model.rear_m, model.width_m / 2.0, model.swing_radius_m};
    limits.v_max_mps = model.v_max_mps;
    limits.omega_max_radps = model.omega_max_radps;
    EXPECT_TRUE(is_valid(limits));
    EXPECT_LE(reach_m(limits.footprint), model.swing_radius_m);
  }
}

TEST(RobotLimits, TakeLimitsChangesTheDriveLimitsAlone) {
  RobotLimits limits;
  limits.margin_m = 0.09;
  limits.allow_reverse = true;
  limits.take_limits({1.1, 1.2, 1.3, 1.4, 1.5});
  EXPECT_EQ(limits.v_max_mps, 1.1);
  EXPECT_EQ(limits.omega_max_radps, 1.2);
  EXPECT_EQ(limits.acceleration_mps2, 1.3);
  EXPECT_EQ(limits.deceleration_mps2, 1.4);
  EXPECT_EQ(limits.angular_acceleration_radps2, 1.5);
  EXPECT_EQ(limits.margin_m, 0.09);
  EXPECT_TRUE(limits.allow_reverse);
}

Footprint any_footprint() {
  Footprint f{uniform(0.05, 0.6), uniform(0.05, 0.6), uniform(0.05, 0.4)};
  if (*rc::gen::arbitrary<bool>()) f.swing_radius_m = f.half_width_m + uniform(0.0, 0.6);
  return f;
}

TEST(Footprint, ReachIsTheFarthestPointOfTheOutline) {
  EXPECT_TRUE(rc::check([] {
    const Footprint f = any_footprint();
    constexpr int kSteps = 200;
    double farthest_m = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double part = static_cast<double>(i) / kSteps;
      const double x_m = -f.rear_m + part * (f.front_m + f.rear_m);
      for (const double y_m : {f.half_width_m, f.half_width_m * part}) {
        for (const double end_m : {x_m, f.front_m, -f.rear_m}) {
          const double r_m = std::hypot(end_m, y_m);
          if (r_m <= f.swing_radius_m) farthest_m = std::max(farthest_m, r_m);
        }
      }
    }
    RC_ASSERT(farthest_m <= reach_m(f) + 1e-12);
    RC_ASSERT(farthest_m >= reach_m(f) - 0.01);
  }));
}

TEST(Footprint, GrowingAddsUpAndShrinkingUndoesIt) {
  EXPECT_TRUE(rc::check([] {
    const Footprint f = any_footprint();
    const double a_m = uniform(0.0, 0.3), b_m = uniform(0.0, 0.3);
    const Footprint once = grown(f, a_m + b_m), twice = grown(grown(f, a_m), b_m),
                    back = grown(once, -a_m - b_m);
    RC_ASSERT(std::abs(reach_m(once) - reach_m(twice)) < 1e-12);
    RC_ASSERT(std::abs(reach_m(back) - reach_m(f)) < 1e-12);
    RC_ASSERT(reach_m(once) >= reach_m(f));
    RC_ASSERT(reach_m(once) <= reach_m(f) + std::numbers::sqrt2 * (a_m + b_m) + 1e-12);
    RC_ASSERT(std::isinf(once.swing_radius_m) == std::isinf(f.swing_radius_m));
  }));
}

}  // namespace
}  // namespace topo::types

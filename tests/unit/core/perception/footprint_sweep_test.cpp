// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/perception/footprint_sweep.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/core/motion/generators.hpp"

namespace topo::perception {
namespace {

using motion::uniform;

using types::Twist2;
using types::Vector2;

constexpr types::Footprint kRobot{0.2, 0.3, 0.25};

/// The same by small steps.
double contact_by_steps_s(const Vector2& p, const Twist2& t, const types::Footprint& f, double limit_s) {
  constexpr double kStep_s = 1e-3;
  for (double s = 0.0; s <= limit_s; s += kStep_s) {
    const double a = t.omega_radps * s;
    const bool straight = std::abs(t.omega_radps) < 1e-9;
    const types::Se2 pose{straight ? t.v_mps * s : t.v_mps / t.omega_radps * std::sin(a),
                          straight ? 0.0 : t.v_mps / t.omega_radps * (1.0 - std::cos(a)), a};
    if (contains(f, pose.inverse() * p)) return s;
  }
  return kNever_s;
}

TEST(FootprintSweep, StraightAhead) {
  EXPECT_DOUBLE_EQ(contact_time_s({1.2, 0.0}, {0.5, 0.0}, kRobot), 2.0);
  EXPECT_EQ(contact_time_s({1.2, 0.26}, {0.5, 0.0}, kRobot), kNever_s);
  EXPECT_EQ(contact_time_s({-1.2, 0.0}, {0.5, 0.0}, kRobot), kNever_s);
  EXPECT_DOUBLE_EQ(contact_time_s({-1.3, 0.0}, {-0.5, 0.0}, kRobot), 2.0);
  EXPECT_EQ(contact_time_s({0.1, 0.1}, {0.5, 0.0}, kRobot), 0.0);
  EXPECT_EQ(contact_time_s({1.0, 0.0}, {0.0, 0.0}, kRobot), kNever_s);
}

TEST(FootprintSweep, ATurnOnTheSpotMeetsOnlyWhatIsWithinTheSwing) {
  const double swing_m = std::hypot(0.3, 0.25);
  EXPECT_EQ(contact_time_s({0.0, swing_m + 0.01}, {0.0, 1.0}, kRobot), kNever_s);
  EXPECT_LT(contact_time_s({0.0, swing_m - 0.01}, {0.0, 1.0}, kRobot), 2.0 * std::numbers::pi);
}

TEST(FootprintSweep, AgreesWithSmallStepsOnAnyArc) {
  EXPECT_TRUE(rc::check([] {
    const Vector2 p{uniform(-2.0, 2.0), uniform(-2.0, 2.0)};
    const Twist2 t{uniform(-1.0, 1.0), uniform(-2.0, 2.0)};
    constexpr double kLimit_s = 3.0;
    const double expected = contact_by_steps_s(p, t, kRobot, kLimit_s);
    const double found = contact_time_s(p, t, kRobot);
    if (expected != kNever_s) RC_ASSERT(std::abs(found - expected) < 2e-3 || found < expected);
    // A touch shorter than a step is missed by the steps: then a slightly smaller robot is not touched
    // either.
    if (found < kLimit_s - 2e-3 && expected > found + 2e-3)
      RC_ASSERT(contact_time_s(p, t, types::grown(kRobot, -2e-3)) > found + 1e-3);
  }));
}

TEST(FootprintSweep, TheMarginStopsAMotionTowardsButNotAlong) {
  const Vector2 beside{0.0, 0.27};
  EXPECT_EQ(contact_time_with_margin_s(beside, {0.5, 0.0}, kRobot, 0.05, {}), kNever_s);
  const Vector2 ahead{0.22, 0.0};
  EXPECT_EQ(contact_time_with_margin_s(ahead, {0.5, 0.0}, kRobot, 0.05, {}), 0.0);
  EXPECT_EQ(contact_time_with_margin_s(ahead, {-0.5, 0.0}, kRobot, 0.05, {}), kNever_s);
  EXPECT_NEAR(contact_time_with_margin_s({1.25, 0.0}, {0.5, 0.0}, kRobot, 0.05, {}), 2.0, 1e-9);
}

types::Footprint any_outline() {
  types::Footprint f{uniform(0.1, 0.4), uniform(0.1, 0.4), uniform(0.1, 0.3)};
  if (*rc::gen::arbitrary<bool>()) f.swing_radius_m = f.half_width_m + uniform(0.0, 0.3);
  return f;
}

/// Where the ray at an angle from the centre leaves the outline.
Vector2 on_outline(const types::Footprint& f, double angle_rad) {
  const Vector2 along(std::cos(angle_rad), std::sin(angle_rad));
  double low_m = 0.0, high_m = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    (contains(f, middle_m * along) ? low_m : high_m) = middle_m;
  }
  return low_m * along;
}

TEST(FootprintSweep, DistanceIsThatToTheNearestPointOfTheOutline) {
  EXPECT_TRUE(rc::check([] {
    const types::Footprint f = any_outline();
    const Vector2 p{uniform(-1.0, 1.0), uniform(-1.0, 1.0)};
    const double found_m = distance_m(p, f);
    RC_ASSERT((found_m == 0.0) == contains(f, p));
    if (contains(f, p)) return;
    double expected_m = HUGE_VAL;
    constexpr int kRays = 1500;
    for (int i = 0; i < kRays; ++i)
      expected_m = std::min(expected_m, (p - on_outline(f, 2.0 * std::numbers::pi * i / kRays)).norm());
    RC_ASSERT(found_m <= expected_m + 1e-9);
    RC_ASSERT(found_m >= expected_m - 0.003);
  }));
}

TEST(FootprintSweep, AMirroredMotionMeetsTheMirroredPointThen) {
  EXPECT_TRUE(rc::check([] {
    const types::Footprint f = any_outline();
    const types::Footprint back{f.rear_m, f.front_m, f.half_width_m, f.swing_radius_m};
    const Vector2 p{uniform(-1.5, 1.5), uniform(-1.5, 1.5)};
    const Twist2 t{uniform(-1.0, 1.0), uniform(-2.0, 2.0)};
    const double margin_m = uniform(0.0, 0.1);
    const auto differs = [](double a, double b) { return std::abs(a - b) > 1e-6 && a != b; };
    const double at_s = contact_time_s(p, t, f), kept_s = contact_time_with_margin_s(p, t, f, margin_m, {});
    const Vector2 aside{p.x(), -p.y()}, behind{-p.x(), p.y()};
    RC_ASSERT(!differs(at_s, contact_time_s(aside, {t.v_mps, -t.omega_radps}, f)));
    RC_ASSERT(
        !differs(kept_s, contact_time_with_margin_s(aside, {t.v_mps, -t.omega_radps}, f, margin_m, {})));
    RC_ASSERT(!differs(at_s, contact_time_s(behind, {-t.v_mps, -t.omega_radps}, back)));
  }));
}

TEST(FootprintSweep, TwiceAsFastItMeetsInHalfTheTime) {
  EXPECT_TRUE(rc::check([] {
    const types::Footprint f = any_outline();
    const Vector2 p{uniform(-1.5, 1.5), uniform(-1.5, 1.5)};
    const Twist2 t{uniform(-1.0, 1.0), uniform(-2.0, 2.0)}, twice{2.0 * t.v_mps, 2.0 * t.omega_radps};
    RC_ASSERT(contact_time_s(p, twice, f) == 0.5 * contact_time_s(p, t, f));
    // At the rim, where noise puts points, only motion towards a point counts.
    if (!contains(f, p)) RC_ASSERT(contact_time_with_margin_s(p, t, f, 0.0, {}) == contact_time_s(p, t, f));
  }));
}

TEST(FootprintSweep, AWiderMarginIsMetNoLater) {
  EXPECT_TRUE(rc::check([] {
    const types::Footprint f = any_outline();
    const Vector2 p{uniform(-1.5, 1.5), uniform(-1.5, 1.5)};
    const Twist2 t{uniform(-1.0, 1.0), uniform(-2.0, 2.0)};
    const double narrow_m = uniform(0.0, 0.1), wide_m = narrow_m + uniform(0.0, 0.1);
    // Within a margin, only motion towards the point counts.
    if (contains(types::grown(f, wide_m), p)) return;
    const double narrow_s = contact_time_with_margin_s(p, t, f, narrow_m, {});
    RC_ASSERT(contact_time_with_margin_s(p, t, f, wide_m, {}) <= narrow_s + 1e-9);
  }));
}

TEST(FirstContact, IsThatOfAllPointsThoughItLooksAtFew) {
  std::size_t offered = 0, looked_at = 0;
  EXPECT_TRUE(rc::check([&] {
    types::Footprint f = kRobot;
    if (*rc::gen::arbitrary<bool>()) f.swing_radius_m = uniform(0.26, 0.45);
    const double margin_m = uniform(0.0, 0.1);
    const bool on_the_spot = *rc::gen::inRange(0, 4) == 0;
    const Twist2 t{on_the_spot ? 0.0 : uniform(-1.0, 1.0), uniform(-2.0, 2.0)};
    const double until_s = *rc::gen::arbitrary<bool>() ? kNever_s : uniform(0.0, 4.0);
    FirstContact first(t, types::reach_m(types::grown(f, margin_m)), until_s);
    double expected_s = until_s;
    for (int i = 0; i < 60; ++i) {
      const Vector2 p{uniform(-3.0, 3.0), uniform(-3.0, 3.0)};
      const double at_s = contact_time_with_margin_s(p, t, f, margin_m, {});
      expected_s = std::min(expected_s, at_s);
      ++offered;
      first.offer(p, [&] { return ++looked_at, at_s; });
    }
    RC_ASSERT(first.seconds() == expected_s);
  }));
  EXPECT_LT(looked_at, offered / 2);
}

}  // namespace
}  // namespace topo::perception

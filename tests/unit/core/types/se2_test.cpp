// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/types/se2.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace topo::types {
namespace {

Se2 any_pose() {
  const auto number = [](int range) { return *rc::gen::inRange(-range, range) / 1000.0; };
  return {number(50000), number(50000), number(3141)};
}

void expect_near(const Se2& a, const Se2& b, double tolerance) {
  EXPECT_NEAR(a.x_m, b.x_m, tolerance);
  EXPECT_NEAR(a.y_m, b.y_m, tolerance);
  EXPECT_NEAR(wrap_angle(a.theta_rad - b.theta_rad), 0.0, tolerance);
}

TEST(WrapAngle, StaysInTheHalfOpenTurn) {
  EXPECT_TRUE(rc::check("wrapped angles lie in (-pi, pi] and differ by whole turns", [] {
    const double angle = *rc::gen::inRange(-100000, 100000) / 1000.0;
    const double wrapped = wrap_angle(angle);
    RC_ASSERT(wrapped > -std::numbers::pi);
    RC_ASSERT(wrapped <= std::numbers::pi);
    RC_ASSERT(std::abs(std::remainder(wrapped - angle, 2.0 * std::numbers::pi)) < 1e-9);
  }));
}

TEST(WrapAngle, MapsMinusPiToPi) { EXPECT_DOUBLE_EQ(wrap_angle(-std::numbers::pi), std::numbers::pi); }

TEST(WithinQuarter, IsTheSameDirectionOfWallsNextToZero) {
  EXPECT_TRUE(rc::check("angles within an eighth of a turn that differ by whole quarter turns", [] {
    const double angle = *rc::gen::inRange(-100000, 100000) / 1000.0;
    const double within = within_quarter(angle);
    RC_ASSERT(std::abs(within) <= std::numbers::pi / 4.0);
    const double quarters = (within - angle) / (std::numbers::pi / 2.0);
    RC_ASSERT(std::abs(quarters - std::round(quarters)) < 1e-9);
  }));
}

TEST(Se2, DistanceIsOfThePlacesAlone) {
  EXPECT_DOUBLE_EQ(distance_m({1.0, 2.0, 3.0}, {-2.0, 6.0, -1.0}), 5.0);
  EXPECT_EQ(distance_m({1.0, 2.0, 3.0}, {1.0, 2.0, -3.0}), 0.0);
}

TEST(Se2, ApartIsFurtherOrTurnedMore) {
  EXPECT_FALSE(is_apart({1.0, 2.0, 0.1}, {1.0, 2.5, 0.4}, 0.5, 0.31)) << "neither is more";
  EXPECT_TRUE(is_apart({1.0, 2.0, 0.1}, {1.0, 2.51, 0.1}, 0.5, 0.31));
  EXPECT_TRUE(is_apart({1.0, 2.0, 0.1}, {1.0, 2.0, -0.22}, 0.5, 0.31));
  EXPECT_FALSE(is_apart({0.0, 0.0, 3.1}, {0.0, 0.0, -3.1}, 0.5, 0.31)) << "both look back";
}

TEST(Se2, InverseUndoes) {
  EXPECT_TRUE(rc::check("T * T^-1 = 1 and (A B) p = A (B p)", [] {
    const Se2 a = any_pose(), b = any_pose();
    expect_near(a * a.inverse(), {}, 1e-9);
    expect_near(a.inverse() * a, {}, 1e-9);
    const Vector2 p(*rc::gen::inRange(-100, 100), *rc::gen::inRange(-100, 100));
    RC_ASSERT((((a * b) * p) - (a * (b * p))).norm() < 1e-9);
  }));
}

TEST(Se2, RotatesBeforeItTranslates) {
  const Vector2 p = Se2{1.0, 2.0, std::numbers::pi / 2} * Vector2(1.0, 0.0);
  EXPECT_NEAR(p.x(), 1.0, 1e-12);
  EXPECT_NEAR(p.y(), 3.0, 1e-12);
}

TEST(WrapAngle, IsItsOwnResultAndKeepsSumsOfTurns) {
  EXPECT_TRUE(rc::check("idempotent, and the same for whole turns more", [] {
    const double angle = *rc::gen::inRange(-3141, 3142) / 1000.0;
    const int turns = *rc::gen::inRange(-20, 21);
    RC_ASSERT(wrap_angle(angle) == angle);
    RC_ASSERT(std::abs(wrap_angle(angle + turns * 2.0 * std::numbers::pi) - angle) < 1e-9);
  }));
}

TEST(Se2, ProductsAreAssociativeAndKeepDistances) {
  EXPECT_TRUE(rc::check("(A B) C = A (B C)", [] {
    const Se2 a = any_pose(), b = any_pose(), c = any_pose();
    expect_near((a * b) * c, a * (b * c), 1e-9);
    expect_near((a * b).inverse(), b.inverse() * a.inverse(), 1e-9);
    RC_ASSERT(std::abs(distance_m(a * b, a * c) - distance_m(b, c)) < 1e-9);
    RC_ASSERT(distance_m(a, c) <= distance_m(a, b) + distance_m(b, c) + 1e-9);
  }));
}

TEST(Interpolate, BeginsAndEndsWhereItShouldAndIsEven) {
  EXPECT_TRUE(rc::check("ends, reversal and halving", [] {
    const Se2 a = any_pose(), b = any_pose();
    // Half a turn apart either way round is as short.
    RC_PRE(std::abs(wrap_angle(b.theta_rad - a.theta_rad)) < 3.1);
    const double t = *rc::gen::inRange(0, 1001) / 1000.0;
    expect_near(interpolate(a, b, 0.0), a, 1e-9);
    expect_near(interpolate(a, b, 1.0), b, 1e-9);
    expect_near(interpolate(a, b, t), interpolate(b, a, 1.0 - t), 1e-9);
    expect_near(interpolate(a, interpolate(a, b, 0.5), t), interpolate(a, b, 0.5 * t), 1e-9);
    RC_ASSERT(std::abs(distance_m(a, interpolate(a, b, t)) - t * distance_m(a, b)) < 1e-9);
  }));
}

TEST(Interpolate, TakesTheShortWayRound) {
  const Se2 middle = interpolate({0.0, 0.0, 3.0}, {2.0, 0.0, -3.0}, 0.5);
  EXPECT_NEAR(middle.x_m, 1.0, 1e-12);
  EXPECT_NEAR(std::abs(middle.theta_rad), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace topo::types

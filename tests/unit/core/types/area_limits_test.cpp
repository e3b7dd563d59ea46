// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/area_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/core/motion/generators.hpp"

namespace topo::types {
namespace {

using motion::uniform;

using types::Se2;
using types::Twist2;
using types::Vector2;

AreaLimits court_with_a_hole() {
  AreaLimits limits;
  limits.keep_in = Polygon{{0.0, 0.0}, {10.0, 0.0}, {10.0, 6.0}, {0.0, 6.0}};
  limits.keep_out.push_back({{4.0, 2.0}, {6.0, 2.0}, {5.0, 4.0}});
  return limits;
}

TEST(AreaLimits, WithoutAnyEverythingIsAllowed) {
  const AreaLimits none;
  EXPECT_TRUE(allows(none, {1e6, -1e6}));
  EXPECT_EQ(area_free_time_s(none, {}, {0.7, 0.0}, {}, 5.0), HUGE_VAL);
}

TEST(AreaLimits, PointsAndEdges) {
  const AreaLimits limits = court_with_a_hole();
  EXPECT_TRUE(allows(limits, {1.0, 1.0}));
  EXPECT_FALSE(allows(limits, {-0.1, 1.0}));
  EXPECT_FALSE(allows(limits, {5.0, 3.0}));
  EXPECT_FALSE(allows(limits, {0.0, 3.0})) << "on the edge";
  EXPECT_FALSE(allows(limits, {5.0, 2.0})) << "on the edge of the hole";
}

/// The regular polygon of some corners about a place, counter-clockwise or clockwise, from any corner on.
Polygon any_polygon(const Vector2& centre) {
  const int corners = *rc::gen::inRange(3, 9), first = *rc::gen::inRange(0, 9);
  const double radius_m = uniform(0.5, 2.0), turn_rad = uniform(0.0, 6.0);
  const double sense = *rc::gen::element(-1.0, 1.0);
  Polygon polygon;
  for (int i = first; i < first + corners; ++i) {
    const double angle_rad = turn_rad + sense * 2.0 * std::numbers::pi * i / corners;
    polygon.emplace_back(centre + radius_m * Vector2(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return polygon;
}

/// How deep a point is in a convex polygon about `centre`: the least distance inside of an edge's line.
double depth_in(const Polygon& polygon, const Vector2& centre, const Vector2& p) {
  double least_m = HUGE_VAL;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 &a = polygon[i], along = (polygon[(i + 1) % polygon.size()] - a).normalized();
    const Vector2 normal(-along.y(), along.x());
    const double side = normal.dot(centre - a) > 0.0 ? 1.0 : -1.0;
    least_m = std::min(least_m, side * normal.dot(p - a));
  }
  return least_m;
}

TEST(AreaLimits, InsideAConvexPolygonIsInsideOfAllEdges) {
  EXPECT_TRUE(rc::check([] {
    const Vector2 centre{uniform(-5.0, 5.0), uniform(-5.0, 5.0)};
    const Vector2 p = centre + Vector2(uniform(-2.0, 2.0), uniform(-2.0, 2.0));
    const Polygon polygon = any_polygon(centre);
    const double depth_m = depth_in(polygon, centre, p);
    RC_PRE(std::abs(depth_m) > 1e-6);
    AreaLimits in, out;
    in.keep_in = polygon;
    out.keep_out = {polygon};
    RC_ASSERT(allows(in, p) == (depth_m > 0.0));
    RC_ASSERT(allows(out, p) == (depth_m < 0.0));
    const Footprint point{1e-6, 1e-6, 1e-6};
    if (depth_m > 0.0)
      RC_ASSERT(std::abs(intrusion_m(out, {p.x(), p.y(), 0.3}, point) - depth_m) < 1e-5);
    else
      RC_ASSERT(intrusion_m(out, {p.x(), p.y(), 0.3}, point) < 1e-5);
    if (depth_m > 1e-5) RC_ASSERT(intrusion_m(in, {p.x(), p.y(), 0.3}, point) == 0.0);
  }));
}

AreaLimits moved(const AreaLimits& limits, const Se2& by) {
  AreaLimits out = limits;
  for (Vector2& p : *out.keep_in) p = by * Vector2(p);
  for (Polygon& polygon : out.keep_out)
    for (Vector2& p : polygon) p = by * Vector2(p);
  return out;
}

TEST(AreaLimits, AreTheSameWhereverTheMapLies) {
  EXPECT_TRUE(rc::check([] {
    const Se2 by{uniform(-50.0, 50.0), uniform(-50.0, 50.0), uniform(-3.0, 3.0)};
    const AreaLimits here = court_with_a_hole(), there = moved(here, by);
    const Footprint robot{0.21, 0.3, 0.21, 0.27};
    const Se2 pose{uniform(-1.0, 11.0), uniform(-1.0, 7.0), uniform(-3.0, 3.0)};
    const double depth_m = intrusion_m(here, pose, robot);
    RC_ASSERT(std::abs(intrusion_m(there, by * pose, robot) - depth_m) < 1e-9);
    const Twist2 twist{uniform(-0.7, 0.7), uniform(-1.4, 1.4)};
    const double rim_mps = std::abs(twist.v_mps) + std::abs(twist.omega_radps) * reach_m(robot);
    if (depth_m > 0.0 || rim_mps < 0.1) return;
    const double free_s = area_free_time_s(here, pose, twist, robot, 5.0);
    const double moved_s = area_free_time_s(there, by * pose, twist, robot, 5.0);
    // A corner that only touches an edge may be found a step earlier or later.
    if (std::isfinite(free_s) && std::isfinite(moved_s))
      RC_ASSERT(std::abs(free_s - moved_s) <= 0.031 / rim_mps);
  }));
}

/// Inside of a convex area, a ray outwards leaves it once only: the farther out, the deeper.
TEST(AreaLimits, ALargerRobotIntrudesNoLessAndHasNoMoreTime) {
  EXPECT_TRUE(rc::check([] {
    AreaLimits limits = court_with_a_hole();
    limits.keep_out.clear();
    const Footprint robot{0.21, 0.3, 0.21}, wide = grown(robot, uniform(0.0, 0.2));
    const Se2 pose{uniform(0.1, 9.9), uniform(0.1, 5.9), uniform(-3.0, 3.0)};
    RC_ASSERT(intrusion_m(limits, pose, wide) >= intrusion_m(limits, pose, robot));
    RC_PRE(intrusion_m(limits, pose, wide) == 0.0);
    const double narrow_s = area_free_time_s(limits, pose, {0.5, 0.0}, robot, 30.0);
    RC_ASSERT(area_free_time_s(limits, pose, {0.5, 0.0}, wide, 30.0) <= narrow_s);
    RC_ASSERT(narrow_s < 30.0);
    RC_ASSERT(area_free_time_s(limits, pose, {}, wide, 30.0) == HUGE_VAL);
  }));
}

TEST(AreaLimits, AKeepOutOfNoSizeForbidsNothingButItself) {
  AreaLimits limits;
  limits.keep_out = {Polygon{}, Polygon{{1.0, 1.0}}, Polygon{{2.0, 0.0}, {2.0, 2.0}}};
  EXPECT_FALSE(limits.empty());
  EXPECT_TRUE(allows(limits, {0.0, 0.0}));
  EXPECT_FALSE(allows(limits, {1.0, 1.0})) << "on its only corner";
  EXPECT_FALSE(allows(limits, {2.0, 1.0})) << "on its line";
  EXPECT_EQ(intrusion_m(limits, {2.0, 1.0, 0.0}, {}), 0.0);
}

TEST(AreaLimits, StopsBeforeTheEdgeAndComesBackIn) {
  const AreaLimits limits = court_with_a_hole();
  const Footprint robot{0.2, 0.3, 0.2};
  EXPECT_NEAR(area_free_time_s(limits, {1.0, 1.0, 3.14159265}, {0.5, 0.0}, robot, 5.0), 1.6, 0.1);
  EXPECT_EQ(area_free_time_s(limits, {1.0, 1.0, 0.0}, {0.5, 0.0}, robot, 5.0), HUGE_VAL);
  const Se2 out{10.05, 3.0, 0.0};  // astride the edge, the nose outside
  EXPECT_LT(area_free_time_s(limits, out, {0.5, 0.0}, robot, 5.0), 0.1);
  EXPECT_EQ(area_free_time_s(limits, out, {-0.1, 0.0}, robot, 5.0), HUGE_VAL);
}

TEST(AreaLimits, WithinTheFreeTimeTheHullStaysInside) {
  EXPECT_TRUE(rc::check([] {
    const AreaLimits limits = court_with_a_hole();
    const Footprint robot{0.21, 0.3, 0.21, 0.27};
    const Se2 start{uniform(0.4, 9.6), uniform(0.4, 5.6), uniform(-3.0, 3.0)};
    RC_PRE(intrusion_m(limits, start, robot) == 0.0);
    const double v = uniform(-0.7, 0.7), omega = uniform(0.01, 1.4);
    const double free_s = area_free_time_s(limits, start, {v, omega}, robot, 6.0);
    const double t = std::min(free_s, 6.0) * uniform(0.0, 1.0);
    const double chord = 2.0 * v / omega * std::sin(0.5 * omega * t);
    const Se2 there =
        start * Se2{chord * std::cos(0.5 * omega * t), chord * std::sin(0.5 * omega * t), omega * t};
    RC_ASSERT(intrusion_m(limits, there, robot) < 0.02);  // a corner may slip between two looks
  }));
}

}  // namespace
}  // namespace topo::types

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/area_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

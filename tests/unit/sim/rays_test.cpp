// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/sim/random.hpp"
#include "tests/sim/world.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::sim {
namespace {

// Distance from inside the rectangle [0, w] x [0, h] to its border.
double to_border(double x, double y, double angle, double w, double h) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double tx = c > 0.0 ? (w - x) / c : c < 0.0 ? -x / c : HUGE_VAL;
  const double ty = s > 0.0 ? (h - y) / s : s < 0.0 ? -y / s : HUGE_VAL;
  return std::min(tx, ty);
}

TEST(Rays, MeetTheWallsOfARoomExactlyAtEveryAngle) {
  const World world = scene(room_text());
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform(0.01, 7.99);
    const double y = random.uniform(0.01, 5.99);
    const double angle = i % 10 == 0 ? 0.5 * std::numbers::pi * (i / 10 % 4) : random.uniform(-4.0, 4.0);
    ASSERT_NEAR(world.level_range_m(x, y, 0.3, angle), to_border(x, y, angle, 8.0, 6.0), 1e-6)
        << x << ' ' << y << ' ' << angle;
  }
}

TEST(Rays, SeeACylinderAsACircle) {
  const World world = scene(room_text() + R"([[cylinder]]
center_m = [6.0, 3.0]
radius_m = 0.5
z_max_m = 1.0
)");
  for (int i = -100; i <= 100; ++i) {
    const double angle = 0.0025 * i;
    const double miss = 4.0 * std::sin(angle);  // the centre's distance from the ray that leaves (2, 3)
    if (std::abs(miss) > 0.49) continue;
    const double expected = 4.0 * std::cos(angle) - std::sqrt(0.25 - miss * miss);
    EXPECT_NEAR(world.level_range_m(2.0, 3.0, 0.3, angle), expected, 0.02);
  }
  EXPECT_NEAR(world.level_range_m(2.0, 3.0, 0.3, 0.0), 3.5, 0.003);
}

/// A low box on the right, one that hangs on the left.
World room_with_boxes() {
  return scene(room_text() + R"([[box]]
center_m = [6.0, 3.0]
length_m = 1.0
width_m = 1.0
z_max_m = 0.4
[[box]]
center_m = [2.0, 3.0]
length_m = 1.0
width_m = 1.0
z_min_m = 0.8
z_max_m = 1.2
)");
}

TEST(Rays, PassAboveLowThingsAndBelowHangingOnes) {
  const World world = room_with_boxes();
  EXPECT_NEAR(world.level_range_m(4.0, 3.0, 0.3, 0.0), 1.5, 1e-9);
  EXPECT_NEAR(world.level_range_m(4.0, 3.0, 0.5, 0.0), 4.0, 1e-9);
  EXPECT_NEAR(world.level_range_m(4.0, 3.0, 1.0, std::numbers::pi), 1.5, 1e-9);
  EXPECT_NEAR(world.level_range_m(4.0, 3.0, 0.5, std::numbers::pi), 4.0, 1e-9);
}

TEST(Rays, MeetFloorCeilingTopsAndBottoms) {
  const World world = room_with_boxes();
  const double r = std::sqrt(0.5);
  EXPECT_EQ(world.cast({4.0, 3.0, 1.0, 0.0, 0.0, -1.0}).surface, Surface::kFloor);
  EXPECT_NEAR(world.cast({4.0, 3.0, 1.0, 0.0, 0.0, -1.0}).range_m, 1.0, 1e-12);
  EXPECT_NEAR(world.cast({4.0, 3.0, 1.0, 0.0, 0.0, 1.0}).range_m, 1.5, 1e-12);
  EXPECT_NEAR(world.cast({6.0, 3.0, 2.0, 0.0, 0.0, -1.0}).range_m, 1.6,
              1e-12);  // straight down on the low box
  EXPECT_NEAR(world.cast({2.0, 3.0, 0.2, 0.0, 0.0, 1.0}).range_m, 0.6,
              1e-12);  // straight up under the hanging one
  EXPECT_NEAR(world.cast({4.0, 3.0, 2.4, r, 0.0, -r}).range_m, 2.0 / r, 1e-9);  // down onto the top at x = 6
  EXPECT_NEAR(world.cast({4.0, 3.0, 1.0, 0.0, r, r}).range_m, 1.5 / r, 1e-9);   // up to the ceiling
}

// Once such a ray took ten million steps of 0.1 um: along a border of the grid, off it by less than rounding
// shows.
TEST(Rays, GetOnAlongTheBordersOfTheGrid) {
  const World world = scene(room_text());
  const Vector2 corner = world.extents().min;
  for (int i = 3; i < 20; ++i) {
    const Vector2 p = corner + 0.25 * Vector2(i, i);
    for (int turn = 0; turn < 4; ++turn) {
      for (const double off : {0.0, 1e-17, -1e-17, 1e-12, -1e-12, 1e-9, -1e-9}) {
        const double angle = 0.5 * std::numbers::pi * turn + off;
        ASSERT_NEAR(world.level_range_m(p.x(), p.y(), 0.3, angle), to_border(p.x(), p.y(), angle, 8.0, 6.0),
                    1e-6);
      }
    }
  }
}

TEST(Rays, EndAtTheirLimit) {
  const World world = scene(room_text());
  RayOptions options;
  options.range_max_m = 2.0;
  EXPECT_EQ(world.level_range_m(4.0, 3.0, 0.3, 0.0, options), HUGE_VAL);
  EXPECT_EQ(world.cast({4.0, 3.0, 0.3, 1.0, 0.0, 0.0}, options).surface, Surface::kNone);
}

TEST(Rays, LookThroughGlassAsOftenAsItIsClear) {
  const World world = scene(room_text() + R"([[glass]]
points_m = [[6.0, 0.0], [6.0, 6.0]]
transmission = 0.7
)");
  Random random(3);
  int through = 0;
  for (int i = 0; i < 10000; ++i) {
    RayOptions options;
    options.glass_draw = random.uniform();
    const RayHit hit = world.cast({4.0, 3.0, 0.3, 1.0, 0.0, 0.0}, options);
    if (hit.surface == Surface::kWall) ++through;
  }
  EXPECT_NEAR(through / 10000.0, 0.7, 0.02);
  EXPECT_EQ(world.cast({4.0, 3.0, 0.3, 1.0, 0.0, 0.0}).surface, Surface::kGlass);  // a solid thing by default
}

TEST(Rays, SeeMovablesUntilTheyAreGone) {
  World world = scene(room_text());
  const MovableId box = world.add_movable(make_box({6.0, 3.0, 0.0}, 0.4, 0.4, 0.0, 1.0));
  EXPECT_NEAR(world.level_range_m(4.0, 3.0, 0.3, 0.0), 1.8, 1e-9);
  RayOptions own;
  own.exclude = box;
  EXPECT_NEAR(world.level_range_m(4.0, 3.0, 0.3, 0.0, own), 4.0, 1e-9);
  world.move_movable(box, make_box({7.0, 3.0, 0.0}, 0.4, 0.4, 0.0, 1.0));
  EXPECT_NEAR(world.level_range_m(4.0, 3.0, 0.3, 0.0), 2.8, 1e-9);
  world.remove_movable(box);
  EXPECT_NEAR(world.level_range_m(4.0, 3.0, 0.3, 0.0), 4.0, 1e-9);
}

}  // namespace
}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/wings.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/types/stamp.hpp"
#include "core/walls/wall_extraction.hpp"

namespace topo::analysis {
namespace {

using types::kDegree_rad;
using types::Segment;
using types::Vector2;

/// The centre of its cell of 0.05 m.
Vector2 cell_centre(const Vector2& p) {
  constexpr double kCell_m = 0.05;
  return kCell_m * ((p / kCell_m).array().floor() + 0.5).matrix();
}

void draw(const Segment& wall, std::vector<Vector2>& points) {
  constexpr double kStep_m = 0.02;
  const int steps = static_cast<int>(wall.length_m() / kStep_m);
  for (int i = 0; i <= steps; ++i) points.push_back(cell_centre(wall.a + (wall.b - wall.a) * i / steps));
}

/// A corridor with rooms of 5 m on both sides, from `at` along a direction.
void draw_wing(const Vector2& at, double direction_rad, int rooms, std::vector<Vector2>& points) {
  const Vector2 along(std::cos(direction_rad), std::sin(direction_rad)), across(-along.y(), along.x());
  const double length_m = 5.0 * rooms;
  for (const double side_m : {-6.0, -1.0, 1.0, 6.0})
    draw({at + side_m * across, at + side_m * across + length_m * along}, points);
  for (int room = 0; room <= rooms; ++room) {
    const Vector2 foot = at + 5.0 * room * along;
    for (const double side : {-1.0, 1.0}) draw({foot + side * across, foot + 6.0 * side * across}, points);
  }
}

void draw_clutter(unsigned seed, int pieces, std::vector<Vector2>& points) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> x_m(0.0, 30.0), y_m(-6.0, 6.0), turn_rad(0.0, std::numbers::pi);
  for (; pieces > 0; --pieces) {
    const Vector2 from(x_m(random), y_m(random));
    const double rad = turn_rad(random);
    draw({from, from + Vector2(std::cos(rad), std::sin(rad))}, points);
  }
}

void only_once(std::vector<Vector2>& points) {
  const auto before = [](const Vector2& a, const Vector2& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  };
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

struct Found {
  double direction_rad = 0.0;
  std::vector<Segment> walls;
  Wings wings;
};

Found found_in(const std::vector<Vector2>& points) {
  const compass::CompassParams compass;
  const walls::WallParams wall_params;
  Found found;
  found.direction_rad = compass::entropy_compass(points, compass).angle_rad.value_or(-1.0);
  found.walls = walls::extract_walls(points, found.direction_rad, wall_params);
  found.wings = skew_wings(points, points, found.direction_rad, found.walls, compass, wall_params, {});
  return found;
}

double off_deg(double found_rad, double true_rad) {
  return std::abs(std::remainder(found_rad - true_rad, 0.5 * std::numbers::pi)) / kDegree_rad;
}

TEST(Wings, TwoThatAreSkewHaveADirectionEach) {
  EXPECT_TRUE(rc::check([] {
    const double first_rad = *rc::gen::inRange(0, 900) * 0.1 * kDegree_rad;
    const double second_rad = first_rad + *rc::gen::inRange(100, 800) * 0.1 * kDegree_rad;
    std::vector<Vector2> points;
    draw_wing({0.0, 0.0}, first_rad, 6, points);
    draw_wing(35.0 * Vector2(std::cos(first_rad), std::sin(first_rad)), second_rad, 4, points);
    draw_clutter(*rc::gen::inRange(0U, 1000U), *rc::gen::inRange(0, 30), points);
    only_once(points);
    const Found found = found_in(points);
    RC_ASSERT(off_deg(found.direction_rad, first_rad) < 0.3);
    RC_ASSERT(found.wings.directions_rad.size() == 1U);
    RC_ASSERT(off_deg(found.wings.directions_rad.front(), second_rad) < 0.3);
    double along_m = 0.0;
    for (const Segment& wall : found.wings.walls) {
      const Vector2 way = wall.b - wall.a;
      RC_ASSERT(off_deg(std::atan2(way.y(), way.x()), found.wings.directions_rad.front()) < 1e-6);
      along_m += wall.length_m();
    }
    RC_ASSERT(along_m > 60.0);
  }));
}

/// Whatever the building's direction on the map's axes: its walls explain their own points.
TEST(Wings, ASmallOneIsFoundBesideABuildingOfAnyDirection) {
  for (double first_deg = 0.0; first_deg < 90.0; first_deg += 7.5) {
    const double second_rad = (first_deg + 25.0) * kDegree_rad;
    std::vector<Vector2> points;
    draw_wing({0.0, 0.0}, first_deg * kDegree_rad, 8, points);
    draw_wing({-40.0, -40.0}, second_rad, 2, points);
    only_once(points);
    const Found found = found_in(points);
    EXPECT_LT(off_deg(found.direction_rad, first_deg * kDegree_rad), 0.3);
    ASSERT_EQ(found.wings.directions_rad.size(), 1U) << first_deg;
    EXPECT_LT(off_deg(found.wings.directions_rad.front(), second_rad), 0.3) << first_deg;
  }
}

/// Neither of them is the stronger, and the lowest entropy of both together may lie between their directions.
TEST(Wings, TwoAlikeBesideEachOtherHaveADirectionEach) {
  EXPECT_TRUE(rc::check([] {
    const double first_rad = *rc::gen::inRange(0, 900) * 0.1 * kDegree_rad;
    const double second_rad = first_rad + *rc::gen::inRange(120, 780) * 0.1 * kDegree_rad;
    std::vector<Vector2> points;
    draw_wing({0.0, 0.0}, first_rad, 5, points);
    draw_wing({60.0, 0.0}, second_rad, 5, points);
    only_once(points);
    const Found found = found_in(points);
    RC_ASSERT(found.wings.directions_rad.size() == 1U);
    const double other_rad = found.wings.directions_rad.front();
    const bool first_is_main = off_deg(found.direction_rad, first_rad) < 0.3;
    RC_ASSERT(first_is_main || off_deg(found.direction_rad, second_rad) < 0.3);
    RC_ASSERT(off_deg(other_rad, first_is_main ? second_rad : first_rad) < 0.3);
  }));
}

TEST(Wings, ThreeThatAreSkewHaveADirectionEach) {
  std::vector<Vector2> points;
  draw_wing({0.0, 0.0}, 0.0, 6, points);
  draw_wing({40.0, 10.0}, 25.0 * kDegree_rad, 5, points);
  draw_wing({-20.0, 20.0}, 60.0 * kDegree_rad, 4, points);
  only_once(points);
  const Found found = found_in(points);
  std::vector<double> all_rad = found.wings.directions_rad;
  all_rad.push_back(found.direction_rad);
  ASSERT_EQ(all_rad.size(), 3U);
  for (const double true_deg : {0.0, 25.0, 60.0}) {
    EXPECT_EQ(std::ranges::count_if(all_rad,
                                    [&](double rad) { return off_deg(rad, true_deg * kDegree_rad) < 0.3; }),
              1)
        << true_deg;
  }
}

/// Furniture stands at all angles, and has no direction in common.
TEST(Wings, ABuildingOfOneDirectionHasNone) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Vector2> points;
    draw_wing({0.0, 0.0}, *rc::gen::inRange(0, 900) * 0.1 * kDegree_rad, 6, points);
    draw_clutter(*rc::gen::inRange(0U, 1000U), *rc::gen::inRange(0, 60), points);
    only_once(points);
    const Found found = found_in(points);
    RC_ASSERT(found.wings.directions_rad.empty());
    RC_ASSERT(found.wings.walls.empty());
  }));
}

TEST(Wings, AreTheSameWhateverTheOrderOfThePoints) {
  std::vector<Vector2> points;
  draw_wing({0.0, 0.0}, 0.1, 6, points);
  draw_wing({35.0, 3.0}, 0.7, 4, points);
  only_once(points);
  const Found found = found_in(points);
  std::shuffle(points.begin(), points.end(), std::mt19937(7));
  const Found shuffled = found_in(points);
  EXPECT_EQ(found.wings.directions_rad, shuffled.wings.directions_rad);
  ASSERT_EQ(found.wings.walls.size(), shuffled.wings.walls.size());
  for (std::size_t i = 0; i < found.wings.walls.size(); ++i) {
    EXPECT_EQ(found.wings.walls[i].a, shuffled.wings.walls[i].a);
    EXPECT_EQ(found.wings.walls[i].b, shuffled.wings.walls[i].b);
  }
}

TEST(Wings, OfNoPointsThereAreNone) {
  const Wings none = skew_wings({}, {}, 0.0, {}, {}, {}, {});
  EXPECT_TRUE(none.directions_rad.empty());
  EXPECT_TRUE(none.walls.empty());
}

}  // namespace
}  // namespace topo::analysis

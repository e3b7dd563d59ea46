// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/wall_extraction.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numbers>

#include "tests/unit/core/walls/points.hpp"

namespace topo::walls {
namespace {

/// Whether a wall lies along the line from a to b, but for `slack_m` at the ends and across.
bool has_wall(const std::vector<types::Segment>& walls, types::Vector2 a, types::Vector2 b, double slack_m) {
  return std::any_of(walls.begin(), walls.end(), [&](const types::Segment& w) {
    return ((w.a - a).norm() <= slack_m && (w.b - b).norm() <= slack_m) ||
           ((w.a - b).norm() <= slack_m && (w.b - a).norm() <= slack_m);
  });
}

TEST(WallExtraction, OfADrawnRectangleAreItsSidesAtEveryAngle) {
  EXPECT_TRUE(rc::check("rectangle", [] {
    const double angle = *rc::gen::inRange(0, 1570) * 0.001;
    const double w = 1.5 + *rc::gen::inRange(0, 100) * 0.1, h = 1.5 + *rc::gen::inRange(0, 100) * 0.1;
    Points points;
    draw_rectangle(points, {0.0, 0.0}, {w, h});
    const auto walls = extract_walls(cell_centres(turned(points, angle)), angle);
    RC_ASSERT(walls.size() == 4U);
    const Points corners = turned({{0.0, 0.0}, {w, 0.0}, {w, h}, {0.0, h}}, angle);
    for (std::size_t i = 0; i < 4; ++i) RC_ASSERT(has_wall(walls, corners[i], corners[(i + 1) % 4], 0.12));
  }));
}

TEST(WallExtraction, FindsTheWallsOfAFurnishedBuilding) {
  Points points = building();
  furnish(points, 5);
  const auto walls = extract_walls(cell_centres(points), 0.0);
  EXPECT_TRUE(has_wall(walls, {0.0, 5.0}, {32.0, 5.0}, 0.5));
  EXPECT_TRUE(has_wall(walls, {0.0, 7.0}, {32.0, 7.0}, 0.5));
  for (const double x : {4.0, 9.5, 14.2, 21.0, 26.3})
    EXPECT_TRUE(has_wall(walls, {x, 0.0}, {x, 5.0}, 0.5)) << x;
}

TEST(WallExtraction, ADoorPartsAWallAndACrackDoesNot) {
  Points points;
  draw_line(points, {0.0, 0.0}, {3.0, 0.0});
  draw_line(points, {3.3, 0.0}, {6.0, 0.0});
  draw_line(points, {6.9, 0.0}, {10.0, 0.0});
  const auto walls = extract_walls(cell_centres(points), 0.0);
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_TRUE(has_wall(walls, {0.0, 0.0}, {6.0, 0.0}, 0.1));
  EXPECT_TRUE(has_wall(walls, {6.9, 0.0}, {10.0, 0.0}, 0.1));
}

TEST(WallExtraction, ShorterThanAMetreIsNoWall) {
  for (const double length : {0.8, 1.2}) {
    Points points;
    draw_line(points, {0.0, 0.0}, {length, 0.0});
    EXPECT_EQ(extract_walls(cell_centres(points), 0.0).size(), length > 1.0 ? 1U : 0U) << length;
  }
}

TEST(WallExtraction, ContrastKeepsMostLinesOfUniformClutterOut) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(0.0, 10.0);
  Points points;
  for (int i = 0; i < 8000; ++i) points.emplace_back(place(random), place(random));
  points = cell_centres(points);
  WallParams any_contrast;
  any_contrast.contrast_min = 0.0;
  const std::size_t lines = extract_walls(points, 0.0, any_contrast).size();
  EXPECT_GT(lines, 50U);
  EXPECT_LT(extract_walls(points, 0.0).size(), lines / 5);
}

TEST(WallExtraction, IsTheSameInAnyOrderOfThePoints) {
  Points points = building();
  furnish(points, 8);
  points = cell_centres(points);
  const auto expected = extract_walls(points, 0.3);
  std::shuffle(points.begin(), points.end(), std::mt19937(4));
  const auto shuffled = extract_walls(points, 0.3);
  ASSERT_EQ(shuffled.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(shuffled[i].a, expected[i].a);
    EXPECT_EQ(shuffled[i].b, expected[i].b);
  }
}

TEST(WallExtraction, OfNothingIsNothing) {
  EXPECT_TRUE(extract_walls({}, 0.4).empty());
  EXPECT_TRUE(extract_walls(Points{{1.0, 1.0}}, 0.4).empty());
  EXPECT_TRUE(extract_walls(Points(100, types::Vector2(1.0, 1.0)), 0.4).empty());
  EXPECT_TRUE(extract_walls(Points{{0.0, 0.0}, {1e9, 1e9}}, 0.4).empty());
}

TEST(WallExtraction, WallsLieOnPointsAlongTheCompass) {
  EXPECT_TRUE(rc::check([] {
    const double angle = *rc::gen::inRange(0, 1570) * 0.001;
    Points points = turned(building(), angle);
    furnish(points, static_cast<unsigned>(*rc::gen::inRange(0, 9)));
    points = cell_centres(points);
    const WallParams params;
    const types::Vector2 along(std::cos(angle), std::sin(angle));
    const auto walls = extract_walls(points, angle, params);
    RC_ASSERT(walls.size() > 4U);
    for (const types::Segment& wall : walls) {
      RC_ASSERT(wall.length_m() >= params.length_min_m - 2e-3);
      const types::Vector2 way = (wall.b - wall.a).normalized();
      const double cosine = std::abs(way.dot(along));
      RC_ASSERT(std::min(cosine, 1.0 - cosine) < 1e-5);
      for (const types::Vector2& end : {wall.a, wall.b}) {
        // A line is two half bins wide: its mean is no farther from a point of it.
        RC_ASSERT(std::any_of(points.begin(), points.end(),
                              [&](const auto& p) { return (p - end).norm() <= params.bin_m; }));
      }
    }
  }));
}

TEST(WallExtraction, AQuarterTurnOfTheCompassFindsTheSameWalls) {
  Points points;
  draw_rectangle(points, {0.0, 0.0}, {6.0, 3.5});
  for (const double angle : {0.2, 0.9}) {
    const Points cells = cell_centres(turned(points, angle));
    const auto walls = extract_walls(cells, angle);
    ASSERT_EQ(walls.size(), 4U);
    for (const int quarters : {-3, -1, 1, 2, 4}) {
      const auto others = extract_walls(cells, angle + quarters * std::numbers::pi / 2.0);
      EXPECT_EQ(others.size(), 4U) << quarters;
      for (const types::Segment& wall : walls)
        EXPECT_TRUE(has_wall(others, wall.a, wall.b, 0.06)) << quarters;
    }
  }
}

TEST(WallPoints, AreTheCellsThatAreWallByTheirHeights) {
  patricia::Arena<Slabs> arena;
  WallStore store(arena, 0.05);
  const Slabs wall = slab_of(0.3) | slab_of(1.0) | slab_of(1.8);
  store.add(store.cell_at({1.01, -2.01}), wall);
  store.add(store.cell_at({3.0, 3.0}), slab_of(0.3) | slab_of(0.4) | slab_of(0.5));
  const auto points = wall_points(store, {});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR((points[0] - types::Vector2(1.025, -2.025)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace topo::walls

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/compass/compass.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numbers>
#include <random>
#include <utility>

#include "tests/unit/core/walls/points.hpp"

namespace topo::compass {
namespace {

using walls::building;
using walls::cell_centres;
using walls::draw_line;
using walls::furnish;
using walls::Points;
using walls::turned;

constexpr double kQuarterTurn = std::numbers::pi / 2.0;

double apart_deg(double a_rad, double b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, kQuarterTurn)) / types::kDegree_rad;
}

TEST(Compass, TurnsWithTheBuilding) {
  const Points plan = building();
  for (int a = 0; a < 90; a += 7) {
    const Compass compass = entropy_compass(cell_centres(turned(plan, a * types::kDegree_rad)));
    ASSERT_TRUE(compass.angle_rad) << a;
    EXPECT_LT(apart_deg(*compass.angle_rad, a * types::kDegree_rad), 0.1) << a;
    EXPECT_GE(*compass.angle_rad, 0.0);
    EXPECT_LT(*compass.angle_rad, kQuarterTurn);
    EXPECT_EQ(compass.entropy.size(), 90U);
  }
}

TEST(Compass, AnswersInStepsThatAFewPointsDoNotChange) {
  for (const double a_deg : {0.0, 33.0, 71.5}) {
    Points points = cell_centres(turned(building(), a_deg * types::kDegree_rad));
    const auto angle_rad = entropy_compass(points).angle_rad;
    ASSERT_TRUE(angle_rad) << a_deg;
    const double steps = *angle_rad / types::kDegree_rad / 0.05;
    EXPECT_NEAR(steps, std::round(steps), 1e-6) << a_deg;
    for (int gone = 10; gone <= 50; gone += 10) {
      points.resize(points.size() - 10);
      EXPECT_EQ(entropy_compass(points).angle_rad, angle_rad) << a_deg << " without " << gone;
    }
  }
}

TEST(Compass, OnBothSidesOfAQuarterTurnIsTheSame) {
  for (const double a_deg : {-0.02, 0.0, 0.02, 89.98, 90.02}) {
    const Points plan = cell_centres(turned(building(), a_deg * types::kDegree_rad));
    EXPECT_EQ(entropy_compass(plan).angle_rad, 0.0) << a_deg;
  }
}

TEST(Compass, IsNotTurnedByFurniture) {
  Points plan = cell_centres(building());
  furnish(plan, 3);
  for (const int a : {0, 7, 23, 45, 47, 61, 89}) {
    const Compass compass = entropy_compass(cell_centres(turned(plan, a * types::kDegree_rad)));
    ASSERT_TRUE(compass.angle_rad) << a;
    EXPECT_LT(apart_deg(*compass.angle_rad, a * types::kDegree_rad), 0.3) << a;
  }
}

/// A yard full of things, long in another direction than the building in it: as a whole it has the lowest
/// entropy along itself, and no wall lies there.
TEST(Compass, IsOfTheWallsAndNotOfTheShapeOfTheWhole) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along_m(-60.0, 60.0), across_m(-4.0, 4.0);
  Points yard;
  for (int i = 0; i < 9000; ++i) yard.emplace_back(along_m(random), across_m(random));
  for (const int a : {12, 20, 35, 70}) {
    Points plan = turned(yard, a * types::kDegree_rad);
    const Points walls = building();
    plan.insert(plan.end(), walls.begin(), walls.end());
    const Compass compass = entropy_compass(cell_centres(plan));
    ASSERT_TRUE(compass.angle_rad) << a;
    EXPECT_LT(apart_deg(*compass.angle_rad, 0.0), 0.1) << a;
  }
}

/// Without walls a minimum that is no sharper than the noise of the curve is not preferred to the lowest
/// value.
TEST(Compass, OfThingsWithoutWallsIsTheShapeOfTheWhole) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> along_m(0.0, 8.0), across_m(0.0, 4.0);
    Points yard;
    for (int i = 0; i < 1200; ++i) yard.emplace_back(along_m(random), across_m(random));
    const Compass compass = entropy_compass(cell_centres(turned(yard, 20.0 * types::kDegree_rad)));
    const double angle_rad = compass.angle_rad.value_or(20.0 * types::kDegree_rad);
    EXPECT_LT(apart_deg(angle_rad, 20.0 * types::kDegree_rad), 10.0) << seed;
  }
}

TEST(Compass, IsTheSameInAnyOrderOfThePoints) {
  EXPECT_TRUE(rc::check("order", [] {
    Points plan = cell_centres(turned(building(), *rc::gen::inRange(0, 90) * types::kDegree_rad));
    furnish(plan, 1);
    CompassParams params;
    params.points_max = static_cast<std::size_t>(*rc::gen::element(3000, 20000));
    const Compass expected = entropy_compass(plan, params);
    std::shuffle(plan.begin(), plan.end(), std::mt19937(static_cast<unsigned>(*rc::gen::inRange(0, 1000))));
    const Compass shuffled = entropy_compass(plan, params);
    RC_ASSERT(shuffled.angle_rad == expected.angle_rad);
    RC_ASSERT(shuffled.entropy == expected.entropy);
    RC_ASSERT(shuffled.confidence == expected.confidence);
  }));
}

TEST(Compass, SaysSoWhereThereIsNoDirection) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, 5.0);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
  for (const int size : {10, 100, 1000, 20000}) {
    Points cloud, circle;
    for (int i = 0; i < size; ++i) {
      cloud.emplace_back(normal(random), normal(random));
      const double a = angle(random);
      circle.emplace_back(8.0 * std::cos(a), 8.0 * std::sin(a));
    }
    EXPECT_FALSE(entropy_compass(cloud).angle_rad) << size;
    EXPECT_FALSE(entropy_compass(circle).angle_rad) << size;
    EXPECT_FALSE(entropy_compass(cell_centres(circle)).angle_rad) << size;
  }
}

TEST(Compass, OfRasteredNoiseIsNotTheRaster) {
  // A disc of noise on cells of 0.1 m, wider than a half bin: its rows are no walls.
  std::mt19937 random(9);
  std::uniform_int_distribution<int> cell(-80, 80);
  Points noise;
  while (noise.size() < 5000) {
    const int x = cell(random), y = cell(random);
    if (x * x + y * y < 6400) noise.emplace_back(x * 0.1, y * 0.1);
  }
  EXPECT_FALSE(entropy_compass(noise, {.cell_m = 0.1}).angle_rad);
}

TEST(Compass, OfNothingOrAPointOrOneCellIsNone) {
  EXPECT_FALSE(entropy_compass({}).angle_rad);
  EXPECT_FALSE(entropy_compass(Points{{1.0, 2.0}}).angle_rad);
  const Points same(1000, types::Vector2(1.0, 2.0));
  const Compass compass = entropy_compass(same);
  EXPECT_FALSE(compass.angle_rad);
  EXPECT_EQ(compass.confidence, 0.0);
}

TEST(Compass, OfOneCorridorWallIsItsDirection) {
  Points wall;
  draw_line(wall, {0.0, 0.0}, {20.0 * std::cos(0.5), 20.0 * std::sin(0.5)});
  const Compass compass = entropy_compass(cell_centres(wall));
  ASSERT_TRUE(compass.angle_rad);
  EXPECT_LT(apart_deg(*compass.angle_rad, 0.5), 0.2);
  EXPECT_GT(compass.confidence, 0.1);
}

TEST(Compass, APointFarOutCostsNoMemory) {
  Points plan = cell_centres(building());
  plan.emplace_back(1e9, -1e9);
  EXPECT_LE(entropy_compass(plan).entropy.size(), 90U);
}

TEST(Compass, HasAValueForEachStepOfAQuarterTurn) {
  const Points plan = cell_centres(building());
  for (const int steps : {4, 30, 90, 180}) {
    const Compass compass = entropy_compass(plan, {.coarse_step_rad = kQuarterTurn / steps});
    EXPECT_EQ(compass.entropy.size(), static_cast<std::size_t>(steps));
    EXPECT_GE(compass.confidence, 0.0);
    EXPECT_LE(compass.confidence, 1.0);
    for (const double entropy : compass.entropy) EXPECT_GT(entropy, 0.0);
  }
  EXPECT_EQ(entropy_compass(plan, {.coarse_step_rad = 10.0}).entropy.size(), 4U) << "but a few";
}

TEST(Compass, OfAMirroredBuildingIsMirrored) {
  for (const int a : {3, 20, 44, 70}) {
    Points plan = turned(building(), a * types::kDegree_rad);
    for (types::Vector2& p : plan) p.y() = -p.y();
    const auto mirrored = entropy_compass(cell_centres(plan)).angle_rad;
    ASSERT_TRUE(mirrored) << a;
    EXPECT_LT(apart_deg(*mirrored, -a * types::kDegree_rad), 0.11) << a;
  }
}

TEST(Compass, DoesNotDependOnWhereTheBuildingStands) {
  for (const auto& [x_m, y_m] : {std::pair(0.0, 0.0), std::pair(123.45, -67.8), std::pair(-2000.0, 900.0)}) {
    Points plan = turned(building(), 0.5);
    for (types::Vector2& p : plan) p += types::Vector2(x_m, y_m);
    const auto angle_rad = entropy_compass(cell_centres(plan)).angle_rad;
    ASSERT_TRUE(angle_rad) << x_m;
    EXPECT_LT(apart_deg(*angle_rad, 0.5), 0.11) << x_m;
  }
}

TEST(Compass, OfFewerPointsIsTheSameDirection) {
  const Points plan = cell_centres(turned(building(), 0.7));
  for (const std::size_t most : {500U, 1000U, 2000U, 70000U}) {
    const auto angle_rad = entropy_compass(plan, {.points_max = most}).angle_rad;
    ASSERT_TRUE(angle_rad) << most;
    EXPECT_LT(apart_deg(*angle_rad, 0.7), 0.5) << most;
  }
}

TEST(Compass, IsNotSaidBelowTheConfidenceThatIsAskedFor) {
  const Points plan = cell_centres(turned(building(), 0.3));
  const Compass compass = entropy_compass(plan);
  ASSERT_TRUE(compass.angle_rad);
  const auto at_least = [&](double confidence) {
    return entropy_compass(plan, {.confidence_min = confidence}).angle_rad;
  };
  EXPECT_EQ(at_least(0.99 * compass.confidence), compass.angle_rad);
  EXPECT_FALSE(at_least(1.01 * compass.confidence));
}

TEST(Compass, WantsThirtyPoints) {
  Points wall;
  for (int i = 0; i < 30; ++i) wall.emplace_back(0.05 * i, 1.0);
  EXPECT_FALSE(entropy_compass(wall).entropy.empty());
  wall.pop_back();
  EXPECT_TRUE(entropy_compass(wall).entropy.empty());
}

}  // namespace
}  // namespace topo::compass

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/wall_direction.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace topo::slam {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

Surfel surfel(double normal_rad, bool planar = true) {
  return {Point::Zero(),
          Point(static_cast<float>(std::cos(normal_rad)), static_cast<float>(std::sin(normal_rad))), planar};
}

TEST(WallDirection, isThatOfTheWallsWhateverFurnitureStandsAround) {
  EXPECT_TRUE(rc::check("modulo a quarter turn", [] {
    const double walls_rad = *rc::gen::inRange(-3600, 3600) / 10.0 * kDegree_rad;
    std::vector<Surfel> surfels;
    for (int i = 0; i < 120; ++i) {  // symmetric noise of a degree: the mean is exact
      const double noise_rad = (i % 2 == 0 ? 1.0 : -1.0) * kDegree_rad;
      surfels.push_back(surfel(walls_rad + i / 2 % 4 * 90.0 * kDegree_rad + noise_rad));
    }
    const int furniture = *rc::gen::inRange(0, 90);
    for (int i = 0; i < furniture; ++i)
      surfels.push_back(surfel(walls_rad + (10.0 + 70.0 * i / 90.0) * kDegree_rad));
    const auto found_rad = wall_direction(surfels);
    RC_ASSERT(found_rad.has_value());
    RC_ASSERT(std::abs(types::within_quarter(*found_rad - walls_rad)) < 0.05 * kDegree_rad);
  }));
}

TEST(WallDirection, isNoneWhereTheNormalsHaveNone) {
  std::vector<Surfel> round_room;
  for (int i = 0; i < 360; ++i) round_room.push_back(surfel(i * kDegree_rad));
  EXPECT_FALSE(wall_direction(round_room));
  EXPECT_FALSE(wall_direction({}));
  EXPECT_FALSE(wall_direction(std::vector<Surfel>(WallDirectionParams{}.surfels_min - 1, surfel(0.3))));
  EXPECT_FALSE(wall_direction(std::vector<Surfel>(300, surfel(0.3, false))))
      << "legs of chairs have no direction";
  EXPECT_TRUE(wall_direction(std::vector<Surfel>(WallDirectionParams{}.surfels_min, surfel(0.3))));
}

TEST(CommonDirection, isTheMeanAcrossTheEndOfTheQuarterToo) {
  const std::vector<double> angles_rad{-1.0 * kDegree_rad, 91.0 * kDegree_rad, 181.0 * kDegree_rad,
                                       269.0 * kDegree_rad};
  const CommonDirection common = common_direction(angles_rad, 3.0 * kDegree_rad);
  EXPECT_EQ(common.near, 4U);
  EXPECT_NEAR(types::within_quarter(common.angle_rad), 0.0, 1e-9);
}

}  // namespace
}  // namespace topo::slam

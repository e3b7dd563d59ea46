// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/column_collector.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace topo::walls {
namespace {

/// Five beams: straight right-down, right, up, left, left-down, counter-clockwise from behind.
types::Scan coronal_scan(float left_m, float up_m, float right_m) {
  types::Scan scan;
  scan.beams = 5;
  scan.geometry.angle_min_rad = static_cast<float>(-0.75 * std::numbers::pi);
  scan.geometry.angle_increment_rad = static_cast<float>(0.375 * std::numbers::pi);
  scan.geometry.range_max_m = 30.0F;
  scan.range_m[0] = types::kNoReturn;
  scan.range_m[1] = right_m;
  scan.range_m[2] = up_m;
  scan.range_m[3] = left_m;
  scan.range_m[4] = types::kInvalid;
  return scan;
}

const double kSide = std::sin(0.375 * std::numbers::pi), kUp = std::cos(0.375 * std::numbers::pi);

TEST(ColumnCollector, PutsBeamsIntoThePlaneAcrossTheRobot) {
  CoronalMount mount;
  mount.x_m = 0.1;
  mount.z_m = 0.5;
  ColumnCollector collector(mount);
  collector.add(coronal_scan(2.0F, 10.0F, 1.0F), {}, {});
  const auto columns = collector.take({});
  ASSERT_EQ(columns.size(), 2U);  // the ceiling, 10.5 m up, is left out; so are the two that are no distances
  EXPECT_NEAR(columns[0].x_m, 0.1, 1e-6);
  EXPECT_NEAR(columns[0].y_m, -kSide, 1e-6);
  EXPECT_EQ(columns[0].slabs, slab_of(0.5 + kUp));
  EXPECT_NEAR(columns[1].y_m, 2.0 * kSide, 1e-6);
  EXPECT_EQ(columns[1].slabs, slab_of(0.5 + 2.0 * kUp));
}

TEST(ColumnCollector, MirroredMountSwapsTheSides) {
  CoronalMount mount;
  mount.mirrored = true;
  ColumnCollector collector(mount);
  collector.add(coronal_scan(2.0F, 10.0F, types::kNoReturn), {}, {});
  const auto columns = collector.take({});
  ASSERT_EQ(columns.size(), 1U);
  EXPECT_NEAR(columns[0].y_m, -2.0 * kSide, 1e-6);
}

TEST(ColumnCollector, StandingStillAddsNothing) {
  ColumnCollector collector({});
  for (int i = 0; i < 10000; ++i) collector.add(coronal_scan(2.0F, 10.0F, 1.0F), {}, {});
  const auto first = collector.take({});
  EXPECT_EQ(first.size(), 2U);
  collector.add(coronal_scan(3.0F, 10.0F, 1.0F), {}, {0.001, 0.0, 0.0});
  EXPECT_TRUE(collector.take({}).empty());
}

TEST(ColumnCollector, HeightsAtOnePlaceAreOneColumnInTheFrameAskedFor) {
  CoronalMount mount;
  mount.z_m = 0.5;
  ColumnCollector collector(mount);
  collector.add(coronal_scan(2.0F, 10.0F, types::kNoReturn), {5.0, 0.0, 0.0}, {5.0, 0.0, 0.0});
  mount.z_m = 0.5;
  collector.add(coronal_scan(2.0F, 10.0F, types::kNoReturn), {5.015, 0.0, 0.0}, {5.015, 0.0, 0.0});
  const auto columns = collector.take({-5.0, 0.0, 0.0});
  ASSERT_EQ(columns.size(), 1U);
  EXPECT_NEAR(columns[0].x_m, 0.0, 0.03);
}

}  // namespace
}  // namespace topo::walls

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/column_collector.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>
#include <numbers>
#include <utility>

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

TEST(ColumnCollector, TheStepOfTheBaseAndTheCellAreParameters) {
  for (const double step_m : {0.01, 0.1}) {
    ColumnCollector collector({}, {.step_m = step_m, .step_rad = 0.005, .cell_m = 0.01F});
    collector.add(coronal_scan(2.0F, 10.0F, types::kNoReturn), {}, {});
    collector.add(coronal_scan(2.0F, 10.0F, types::kNoReturn), {0.05, 0.0, 0.0}, {0.05, 0.0, 0.0});
    EXPECT_EQ(collector.take({}).size(), step_m < 0.05 ? 2U : 1U) << step_m;
  }
}

TEST(ColumnCollector, UnitesWhatEachCellOfTheWayHas) {
  EXPECT_TRUE(rc::check([] {
    const auto any = [](int low, int high) { return *rc::gen::inRange(low, high) * 0.001; };
    CoronalMount mount{.x_m = any(-200, 200), .y_m = any(-200, 200), .z_m = any(200, 600)};
    mount.roll_rad = any(-500, 500);
    mount.mirrored = *rc::gen::arbitrary<bool>();
    ColumnCollector collector(mount);
    std::map<std::pair<int, int>, Slabs> expected;
    const auto cell = [](float v) { return static_cast<int>(std::floor(v / 0.05F)); };
    types::Se2 pose;
    for (int scans = *rc::gen::inRange(1, 5); scans > 0; --scans) {
      types::Scan scan;
      scan.beams = static_cast<std::uint16_t>(*rc::gen::inRange(0, 60));
      scan.geometry.angle_min_rad = -2.3F;
      scan.geometry.angle_increment_rad = 0.08F;
      const types::Se2 first = pose;
      pose = pose * types::Se2{any(20, 300), any(-50, 50), any(-300, 300)};
      for (std::size_t i = 0; i < scan.beams; ++i) {
        const float range_m = static_cast<float>(any(100, 12000));
        scan.range_m[i] = *rc::gen::element(range_m, range_m, types::kNoReturn, types::kInvalid);
        const double r = static_cast<double>(scan.range_m[i]);
        const double angle = static_cast<double>(scan.angle_rad(i)) + mount.roll_rad;
        const double height = mount.z_m + r * std::cos(angle);
        if (!(r <= 10.0 && height >= 0.15 && height <= 2.3)) continue;
        const double part = static_cast<double>(i) / std::max(1, scan.beams - 1);
        const double side = mount.mirrored ? -r : r;
        const types::Vector2 p = types::interpolate(first, pose, part) *
                                 types::Vector2(mount.x_m, mount.y_m + side * std::sin(angle));
        expected[{cell(static_cast<float>(p.y())), cell(static_cast<float>(p.x()))}] |= slab_of(height);
      }
      collector.add(scan, first, pose);
    }
    const auto columns = collector.take({});
    RC_ASSERT(columns.size() == expected.size());
    auto next = expected.begin();
    for (const ColumnPoint& column : columns) {
      RC_ASSERT(cell(column.y_m) == next->first.first);
      RC_ASSERT(cell(column.x_m) == next->first.second);
      RC_ASSERT(column.slabs == next->second);
      ++next;
    }
    RC_ASSERT(collector.take({}).empty());
  }));
}

TEST(ColumnCollector, WhatIsDroppedIsNotTaken) {
  ColumnCollector collector({});
  collector.add(coronal_scan(2.0F, 10.0F, 1.0F), {}, {});
  collector.drop();
  EXPECT_TRUE(collector.take({}).empty());
  collector.add(coronal_scan(2.0F, 10.0F, 1.0F), {}, {});
  EXPECT_TRUE(collector.take({}).empty()) << "the robot still stands where it was";
  collector.add(coronal_scan(2.0F, 10.0F, 1.0F), {0.02, 0.0, 0.0}, {0.02, 0.0, 0.0});
  EXPECT_EQ(collector.take({}).size(), 2U);
}

TEST(ColumnCollector, ATurnOrAStepIsMotionEnough) {
  for (const types::Se2& moved : {types::Se2{0.011, 0.0, 0.0}, {0.0, -0.011, 0.0}, {0.0, 0.0, -0.006}}) {
    ColumnCollector collector({});
    collector.add(coronal_scan(2.0F, 10.0F, 1.0F), {}, {});
    (void)collector.take({});
    collector.add(coronal_scan(2.0F, 10.0F, 1.0F), moved, moved);
    EXPECT_FALSE(collector.take({}).empty());
  }
}

}  // namespace
}  // namespace topo::walls

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include "core/types/geometry.hpp"
#include "core/types/result.hpp"
#include "core/types/scan.hpp"
#include "core/types/stamp.hpp"

namespace topo::types {
namespace {

TEST(Scan, OnlyDistancesAreHits) {
  EXPECT_TRUE(is_hit(0.5F));
  EXPECT_FALSE(is_hit(kNoReturn));
  EXPECT_FALSE(is_hit(kTooNear));
  EXPECT_FALSE(is_hit(kInvalid));
}

TEST(Scan, BeamsRunCounterClockwiseFromTheMinimum) {
  Scan scan;
  scan.beams = 3;
  scan.geometry.angle_min_rad = -0.5F;
  scan.geometry.angle_increment_rad = 0.25F;
  EXPECT_FLOAT_EQ(scan.angle_rad(2), 0.0F);
  EXPECT_EQ(scan.ranges().size(), 3U);
}

TEST(Stamp, SecondsThereAndBack) {
  EXPECT_EQ(stamp_from_seconds(1.5).time_since_epoch(), std::chrono::milliseconds(1500));
  EXPECT_DOUBLE_EQ(to_seconds(stamp_from_seconds(-0.25)), -0.25);
}

TEST(Result, CarriesWhatWasFound) {
  const Result<int> bad = fail(Errc::kNotFound, "/dev/ttyUSB0: no such device", 2);
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().code, Errc::kNotFound);
  EXPECT_EQ(bad.error().sys_errno, 2);
  const Result<int> good = 3;
  EXPECT_EQ(*good, 3);
}

TEST(Rectangle, GrowsFromEmpty) {
  Rectangle r;
  EXPECT_TRUE(r.empty());
  EXPECT_FALSE(r.contains({0.0, 0.0}));
  r.extend({1.0, -2.0});
  EXPECT_FALSE(r.empty());
  r.extend({-1.0, 2.0});
  EXPECT_TRUE(r.contains({0.0, 0.0}));
  EXPECT_FALSE(r.contains({0.0, 2.1}));
}

}  // namespace
}  // namespace topo::types

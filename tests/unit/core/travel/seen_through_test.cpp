// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/travel/seen_through.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace topo::travel {
namespace {

using types::Vector2;
using Way = std::vector<types::KeyframePose>;

types::KeyframePose stood_at(double x_m, double y_m) {
  return {types::Stamp{}, types::Transform2<types::Map, types::Base>(x_m, y_m, 0.0)};
}

/// 270 beams, 135 degrees to either side, all of one range.
types::Scan scan_of(float range_m) {
  types::Scan scan;
  scan.beams = 271;
  scan.geometry.angle_min_rad = -2.3562F;
  scan.geometry.angle_increment_rad = 0.017453F;
  std::fill_n(scan.range_m.begin(), scan.beams, range_m);
  return scan;
}

const Way kAhead{stood_at(0.9, 0.0), stood_at(1.3, 0.0), stood_at(1.7, 0.0)};

double farthest_m(const std::vector<Vector2>& points) {
  double most_m = 0.0;
  for (const Vector2& p : points) most_m = std::max(most_m, p.norm());
  return most_m;
}

TEST(SeenThrough, AWayBeforeAWallIsFreeAsFarAsTheWallLessTheNoise) {
  const auto whole = seen_through(scan_of(4.0F), {}, {kAhead, {}}, {});
  EXPECT_NEAR(farthest_m(whole), 1.7, 1e-9);
  const auto begun = seen_through(scan_of(1.5F), {}, {kAhead, {}}, {});
  EXPECT_NEAR(farthest_m(begun), 1.35, 0.026);
  EXPECT_TRUE(seen_through(scan_of(0.8F), {}, {kAhead, {}}, {}).empty()) << "somebody stands before it";
}

TEST(SeenThrough, ATeamMatesWayCountsToo) {
  const std::vector<Way> mates{kAhead};
  EXPECT_FALSE(seen_through(scan_of(4.0F), {}, {{}, mates}, {}).empty());
}

TEST(SeenThrough, WhatGivesNoEchoProvesNothing) {
  for (const float range_m : {types::kNoReturn, types::kTooNear, types::kInvalid})
    EXPECT_TRUE(seen_through(scan_of(range_m), {}, {kAhead, {}}, {}).empty()) << range_m;
}

TEST(SeenThrough, OneOfTheBeamsBesideAPointSuffices) {
  types::Scan scan = scan_of(4.0F);
  scan.range_m[135] = 0.9F;  // straight ahead
  EXPECT_TRUE(seen_through(scan, {}, {kAhead, {}}, {}).empty());
}

TEST(SeenThrough, BehindTheScannerNothingIsSeen) {
  EXPECT_TRUE(seen_through(scan_of(4.0F), {0.0, 0.0, 3.1}, {kAhead, {}}, {}).empty());
}

TEST(SeenThrough, ALineOverWhichTheRobotWasCarriedIsNoWay) {
  const Way carried{stood_at(0.9, 0.0), stood_at(1.75, 0.0)};
  EXPECT_TRUE(seen_through(scan_of(4.0F), {}, {carried, {}}, {}).empty());
}

/// Wherever the scanner is: every point is on the way, in the field of view, near, and nearer than the scan.
TEST(SeenThrough, PointsAreNearAndBeforeWhatTheScanHits) {
  EXPECT_TRUE(rc::check([] {
    const auto number = [](int low, int high) { return 0.01 * *rc::gen::inRange(low, high); };
    const types::Se2 at{number(-300, 300), number(-300, 300), number(-314, 314)};
    const double range_m = number(50, 600);
    const RouteMapParams params;
    Way way;
    for (double x_m = -4.0; x_m < 4.0; x_m += 0.4) way.push_back(stood_at(x_m, 0.0));
    const auto points = seen_through(scan_of(static_cast<float>(range_m)), at, {way, {}}, params);
    for (const Vector2& p : points) {
      const Vector2 seen = at.inverse() * p;
      RC_ASSERT(std::abs(p.y()) < 1e-9);
      RC_ASSERT(seen.norm() <= range_m - params.live_behind_m + 1e-5);
      RC_ASSERT(seen.norm() <= params.live_range_m + params.keyframe_gap_m);
      RC_ASSERT(std::abs(std::atan2(seen.y(), seen.x())) <= 2.3563);
    }
  }));
}

}  // namespace
}  // namespace topo::travel

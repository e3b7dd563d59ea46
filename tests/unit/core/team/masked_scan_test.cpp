// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/masked_scan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace topo::team {
namespace {

using types::Vector2;

/// 271 beams of one degree, a wall all around at 4 m.
std::unique_ptr<types::Scan> round_room() {
  auto scan = std::make_unique<types::Scan>();
  const auto degree = static_cast<float>(std::numbers::pi / 180.0);
  scan->geometry.angle_min_rad = -135.0F * degree;
  scan->geometry.angle_increment_rad = degree;
  scan->beams = 271;
  for (std::size_t i = 0; i < scan->beams; ++i) scan->range_m[i] = 4.0F;
  return scan;
}

TEST(MaskMates, takesOutWhatEndsAtAMateAndNothingElse) {
  const auto scan = round_room();
  for (std::size_t i = 130; i <= 140; ++i) scan->range_m[i] = 2.0F;  // a robot 2 m ahead
  scan->range_m[20] = types::kNoReturn;
  const types::Se2 T_map_laser{10.0, 5.0, std::numbers::pi / 2.0};  // looks north
  const std::vector<Vector2> mates{{10.0, 7.1}, {30.0, 30.0}};
  EXPECT_EQ(mask_mates(*scan, T_map_laser, mates, 0.6), 11U);
  for (std::size_t i = 0; i < scan->beams; ++i) {
    if (i >= 130 && i <= 140)
      EXPECT_TRUE(std::isnan(scan->range_m[i])) << i;
    else
      EXPECT_EQ(scan->range_m[i], i == 20 ? types::kNoReturn : 4.0F) << i;
  }
}

TEST(MaskMates, withoutMatesNothingChanges) {
  const auto scan = round_room();
  EXPECT_EQ(mask_mates(*scan, {}, {}, 0.6), 0U);
  EXPECT_EQ(mask_mates(*scan, {}, std::vector{Vector2(2.0, 0.0)}, 0.6), 0U) << "they see past it";
}

TEST(MaskMates, theCoronalScannerSeesMateAndCeiling) {
  const auto scan = round_room();
  scan->range_m[135 + 90] = 1.0F;  // level, to the left
  scan->range_m[135 - 90] = 1.0F;  // and to the right, where there is no mate
  scan->range_m[135 + 70] = 1.2F;  // left and up
  const std::vector<Vector2> mates{{0.0, 1.1}};
  EXPECT_EQ(mask_mates_coronal(*scan, {}, mates, 0.3), 2U);
  EXPECT_TRUE(std::isnan(scan->range_m[135 + 90]));
  EXPECT_TRUE(std::isnan(scan->range_m[135 + 70]));
  EXPECT_EQ(scan->range_m[135 + 16], 4.0F) << "the ceiling";
  EXPECT_EQ(scan->range_m[135 - 90], 1.0F);
}

// A mirrored scanner that begins behind counts down to more than a turn and a quarter from (-pi, pi].
TEST(MaskMates, findsAMateWhereverTheSectorBegins) {
  for (const float first_rad : {-14.0F, -4.0F, 0.0F, 4.0F, 14.0F}) {
    for (const float sense : {-1.0F, 1.0F}) {
      const auto scan = round_room();
      scan->geometry.angle_min_rad = first_rad;
      scan->geometry.angle_increment_rad *= sense;
      EXPECT_EQ(mask_mates(*scan, {}, std::vector{Vector2(0.5, 0.0)}, 4.6), 271U)
          << first_rad << ' ' << sense;
    }
  }
}

// Each beam by itself, whatever the scanner's first bearing and sense.
TEST(MaskMates, leavesExactlyTheBeamsThatEndElsewhere) {
  EXPECT_TRUE(rc::check("against each beam by itself", [] {
    const auto real = [](int low, int high) { return *rc::gen::inRange(100 * low, 100 * high) / 100.0; };
    auto scan = round_room();
    scan->geometry.angle_min_rad = static_cast<float>(real(-4, 4));
    if (*rc::gen::arbitrary<bool>()) scan->geometry.angle_increment_rad *= -1.0F;
    for (std::size_t i = 0; i < scan->beams; ++i)
      scan->range_m[i] = i % 7 == 0 ? types::kNoReturn : static_cast<float>(real(0, 5));
    const types::Se2 T_map_laser{real(-5, 5), real(-5, 5), real(-4, 4)};
    const std::vector<Vector2> mates{{real(-7, 7), real(-7, 7)}, {real(-7, 7), real(-7, 7)}};
    const double radius_m = real(0, 2);
    const types::Scan before = *scan;
    (void)mask_mates(*scan, T_map_laser, mates, radius_m);
    for (std::size_t i = 0; i < before.beams; ++i) {
      if (!types::is_hit(before.range_m[i])) continue;
      const double range_m = before.range_m[i], angle_rad = before.angle_rad(i);
      const Vector2 end = T_map_laser * Vector2(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
      const double nearest_m = std::min((mates[0] - end).norm(), (mates[1] - end).norm());
      if (std::abs(nearest_m - radius_m) < 1e-9) continue;  // rounding decides
      RC_ASSERT(std::isnan(scan->range_m[i]) == (nearest_m < radius_m));
    }
  }));
}

}  // namespace
}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/masked_scan.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/range_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/types/scan.hpp"

namespace topo::bench {
namespace {

/// Beams that end at walls from 1 m to `reach_m`, which every tenth does not.
std::vector<CarmenScan> scans_with(float reach_m, float no_return_m) {
  std::vector<CarmenScan> scans(20);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].range_max_m = 80.0F;
    for (std::size_t k = 0; k < 180; ++k) {
      const float share = static_cast<float>((7 * i + 13 * k) % 180) / 180.0F;
      scans[i].range_m.push_back((k + i) % 10 == 0 ? no_return_m : 1.0F + share * (reach_m - 1.0F));
    }
  }
  return scans;
}

TEST(RangeLimit, IsWhereReadingsPileUp) {
  for (const float limit : {8.19F, 10.0F, 32.76F, 50.0F}) {
    const auto found = piled_up_range_m(scans_with(limit - 0.01F, limit));
    ASSERT_TRUE(found.has_value()) << limit;
    EXPECT_LE(*found, limit);
    EXPECT_GT(*found, 0.998F * limit);
  }
}

TEST(RangeLimit, IsTheLastOfTheLmsCodesToo) {
  auto scans = scans_with(8.0F, 8.191F);
  for (std::size_t i = 0; i < scans.size(); i += 2) scans[i].range_m[0] = 8.183F;
  const auto found = piled_up_range_m(scans);
  ASSERT_TRUE(found.has_value());
  EXPECT_LE(*found, 8.183F);
}

TEST(RangeLimit, IsNotSeenWhereWhatDidNotComeBackIsKnown) {
  EXPECT_FALSE(piled_up_range_m(scans_with(25.0F, types::kNoReturn)).has_value());
  EXPECT_FALSE(piled_up_range_m({}).has_value());
}

TEST(RangeLimit, IsNotAWallAtTheEndOfTheView) {
  auto scans = scans_with(20.0F, types::kNoReturn);
  for (std::size_t i = 0; i < scans.size(); ++i) {  // a wall at 21 m with 0.1 m of noise
    for (std::size_t k = 0; k < 180; k += 10)
      scans[i].range_m[k] = 21.0F + 0.001F * static_cast<float>((37 * i + 11 * k) % 100);
  }
  EXPECT_FALSE(piled_up_range_m(scans).has_value());
}

TEST(RangeLimit, IsNotTheEndOfACorridorThatARobotStandsIn) {
  auto scans = scans_with(7.0F, types::kNoReturn);
  for (CarmenScan& scan : scans) {
    for (std::size_t k = 85; k < 95; ++k) scan.range_m[k] = 8.0F;  // to the millimetre, as simulators have it
  }
  EXPECT_FALSE(piled_up_range_m(scans).has_value());
}

TEST(RangeLimit, IsFoundBelowAStrayReading) {
  const auto some = scans_with(7.9F, 8.0F);
  std::vector<CarmenScan> scans;
  for (int i = 0; i < 4; ++i) scans.insert(scans.end(), some.begin(), some.end());  // 14400 readings
  scans[7].range_m[4] = 9.0F;
  const auto found = piled_up_range_m(scans);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, 8.0F, 0.02F);
  EXPECT_EQ(mark_no_return(scans, *found), 1441U);
}

TEST(RangeLimit, MarksWhatDidNotComeBackAndNothingElse) {
  auto scans = scans_with(9.9F, 10.0F);
  EXPECT_EQ(mark_no_return(scans, 9.99F), 360U);
  EXPECT_EQ(scans[3].range_max_m, 9.99F);
  EXPECT_EQ(scans[3].range_m[7], types::kNoReturn);
  EXPECT_EQ(scans[3].range_m[8], scans_with(9.9F, 10.0F)[3].range_m[8]);
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/range_decoder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace topo::hokuyo {
namespace {

TEST(RangeDecoder, UtmAndUstCodes) {
  for (const Family family : {Family::kUtm, Family::kUtmEw, Family::kUst}) {
    const RangeDecoder decode(family, 23, 60000);
    EXPECT_EQ(decode(1), types::kNoReturn);
    EXPECT_EQ(decode(2), types::kTooNear);
    EXPECT_EQ(decode(4), types::kTooNear);
    for (const std::uint32_t code : {0U, 3U, 5U, 22U}) EXPECT_TRUE(std::isnan(decode(code))) << code;
    EXPECT_FLOAT_EQ(decode(23), 0.023F);
    EXPECT_FLOAT_EQ(decode(60000), 60.0F);
    EXPECT_EQ(decode(60001), types::kNoReturn);
    EXPECT_EQ(decode(65533), types::kNoReturn);
  }
}

TEST(RangeDecoder, UrgCodes) {
  const RangeDecoder decode(Family::kUrg, 20, 5600);
  EXPECT_EQ(decode(0), types::kNoReturn);
  EXPECT_EQ(decode(6), types::kNoReturn) << "perhaps something at 5.7 m";
  for (std::uint32_t code = 1; code < 20; ++code) {
    if (code != 6) {
      EXPECT_TRUE(std::isnan(decode(code))) << code;
    }
  }
  EXPECT_FLOAT_EQ(decode(20), 0.020F);
  EXPECT_EQ(decode(5601), types::kNoReturn);
}

TEST(RangeDecoder, NothingOutsideTheSensorsRangeIsADistance) {
  EXPECT_TRUE(rc::check([] {
    const auto family =
        *rc::gen::element(Family::kUtm, Family::kUtmEw, Family::kUst, Family::kUrg, Family::kUnknown);
    const int told = *rc::gen::inRange(0, 1000), max = *rc::gen::inRange(1001, 262143);
    const int min = std::max(told, RangeDecoder::kLeast_mm);
    const RangeDecoder decode(family, told, max);
    const auto raw = *rc::gen::inRange<std::uint32_t>(0, 262144);
    const float range_m = decode(raw);
    const bool inside = raw >= static_cast<std::uint32_t>(min) && raw <= static_cast<std::uint32_t>(max);
    RC_ASSERT(types::is_hit(range_m) == inside);
    if (inside) RC_ASSERT(std::abs(static_cast<double>(range_m) - raw * 1e-3) < 1e-4);
  }));
}

TEST(RangeDecoder, DecodesNothingBeforeItIsSetUp) { EXPECT_FALSE(types::is_hit(RangeDecoder{}(1000))); }

}  // namespace
}  // namespace topo::hokuyo

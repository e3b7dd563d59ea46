// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/place_option.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace topo::bench {
namespace {

using ::testing::HasSubstr;

TEST(PlaceOption, SetsTheFieldOfThatNameAndNoOther) {
  places::PlaceParams params;
  ASSERT_TRUE(set_place_param("density.min", 0.5, params).has_value());
  ASSERT_TRUE(set_place_param("first.passage_ratio", 1.5, params).has_value());
  ASSERT_TRUE(set_place_param("corner.spurs_ratio", 3.0, params).has_value());
  EXPECT_DOUBLE_EQ(params.density.min, 0.5);
  EXPECT_FLOAT_EQ(params.first.passage_ratio, 1.5F);
  EXPECT_EQ(params.corner.spurs_ratio, 3U);
  EXPECT_DOUBLE_EQ(params.density.elsewhere_weight, places::PlaceParams{}.density.elsewhere_weight);
}

TEST(PlaceOption, RefusesANameOrAValueThatIsNone) {
  places::PlaceParams params;
  const auto unknown = set_place_param("density", 0.5, params);
  ASSERT_FALSE(unknown.has_value());
  EXPECT_THAT(unknown.error().message, HasSubstr("found 'density'"));
  EXPECT_THAT(unknown.error().message, HasSubstr("density.min, density.elsewhere_weight"));
  for (const double value : {0.0, -1.0, HUGE_VAL, std::nan("")})
    EXPECT_FALSE(set_place_param("density.min", value, params).has_value()) << value;
  EXPECT_FALSE(set_place_param("corner.spurs_ratio", 2.5, params).has_value());
  EXPECT_DOUBLE_EQ(params.density.min, places::PlaceParams{}.density.min);
}

}  // namespace
}  // namespace topo::bench

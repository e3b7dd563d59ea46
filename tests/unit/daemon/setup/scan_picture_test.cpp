// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/setup/scan_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "core/types/se2.hpp"

namespace topo::daemon {
namespace {

/// One beam that hits.
std::vector<std::string> picture_of(double degrees, float range_m) {
  const auto scan = std::make_unique<types::Scan>();
  scan->beams = 1;
  scan->geometry.angle_min_rad = static_cast<float>(degrees * types::kDegree_rad);
  scan->range_m[0] = range_m;
  return scan_picture(*scan);
}

std::pair<std::size_t, std::size_t> place_of(const std::vector<std::string>& lines, char mark) {
  for (std::size_t row = 0; row < lines.size(); ++row)
    if (const auto column = lines[row].find(mark); column != std::string::npos) return {row, column};
  return {lines.size(), 0};
}

TEST(ScanPicture, TheScannerIsInTheMiddle) {
  EXPECT_EQ(place_of(picture_of(0.0, types::kNoReturn), '+'),
            std::make_pair(std::size_t{7}, std::size_t{18}));
}

TEST(ScanPicture, AheadIsUpAndLeftIsLeft) {
  const auto ahead = place_of(picture_of(0.0, 2.0F), '#');
  EXPECT_EQ(ahead, std::make_pair(std::size_t{2}, std::size_t{18}));
  const auto left = place_of(picture_of(90.0, 2.0F), '#');
  EXPECT_EQ(left.first, 7U);
  EXPECT_LT(left.second, 18U);
  EXPECT_GT(place_of(picture_of(-90.0, 2.0F), '#').second, 18U);
  EXPECT_GT(place_of(picture_of(180.0, 2.0F), '#').first, 7U);
}

TEST(ScanPicture, WhatIsNoDistanceOrFarIsNotDrawn) {
  for (const float range_m : {types::kNoReturn, types::kInvalid, types::kTooNear, 30.0F})
    EXPECT_EQ(place_of(picture_of(10.0, range_m), '#').first, picture_of(10.0, range_m).size());
}

TEST(ScanPicture, StandBesideEachOtherWithoutTrailingBlanks) {
  const std::vector<std::string> titles{"one", "two"};
  const std::vector<std::vector<std::string>> pictures{{"#  ", "  "}, {" +"}};
  EXPECT_EQ(side_by_side(titles, pictures), "one  two\n#     +\n\n");
}

}  // namespace
}  // namespace topo::daemon

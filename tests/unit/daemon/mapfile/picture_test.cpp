// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/picture.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace topo::daemon {
namespace {

constexpr Rgb kWhite{255, 255, 255}, kRed{255, 0, 0};

TEST(Picture, LinesJoinTheirEndsWithoutAGap) {
  EXPECT_TRUE(rc::check([] {
    const auto in = [] { return *rc::gen::inRange(0, 40); };
    const int x0 = in(), y0 = in(), x1 = in(), y1 = in();
    Picture picture(40, 40, kWhite);
    picture.line(x0, y0, x1, y1, kRed);
    RC_ASSERT(picture.at(x0, y0) == kRed);
    RC_ASSERT(picture.at(x1, y1) == kRed);
    const auto red = std::count(picture.pixels().begin(), picture.pixels().end(), kRed);
    RC_ASSERT(red == std::max(std::abs(x1 - x0), std::abs(y1 - y0)) + 1);
  }));
}

TEST(Picture, WhatIsOutsideIsCutOff) {
  EXPECT_TRUE(rc::check([](std::int16_t x0, std::int16_t y0, std::int16_t x1, std::int16_t y1) {
    Picture picture(10, 7, kWhite);
    picture.line(x0, y0, x1, y1, kRed);
    picture.disc(x0, y0, 5, kRed);
    RC_ASSERT(picture.pixels().size() == 70U);
  }));
}

TEST(Picture, ADiscHasItsRadius) {
  Picture picture(11, 11, kWhite);
  picture.disc(5, 5, 3, kRed);
  EXPECT_EQ(picture.at(8, 5), kRed);
  EXPECT_EQ(picture.at(5, 2), kRed);
  EXPECT_EQ(picture.at(8, 8), kWhite);
  EXPECT_EQ(picture.at(9, 5), kWhite);
}

TEST(Picture, APathLiesWhereTheMapHasIt) {
  MapImage map{10, 10, 0.5, {-1.0, -1.0, 0.0}, std::vector<MapCell>(100, MapCell::kFree)};
  map.cells[map.index(9, 0)] = MapCell::kOccupied;
  Picture picture = picture_of(map);
  EXPECT_EQ(picture.at(9, 9), (Rgb{0, 0, 0}));
  EXPECT_EQ(picture.at(0, 0), (Rgb{254, 254, 254}));
  const types::Se2 path[] = {{-0.9, 3.9, 0.0}, {1.1, 3.9, 0.0}};  // cells (0, 9) and (4, 9)
  draw_path(picture, map, path, kRed);
  for (int x = 0; x <= 4; ++x) EXPECT_EQ(picture.at(x, 0), kRed) << x;
  EXPECT_NE(picture.at(9, 5), kRed);
}

TEST(Picture, PosesThatAreNoneAreNoHarm) {
  const MapImage map{4, 4, 0.05, {}, std::vector<MapCell>(16, MapCell::kUnknown)};
  Picture picture = picture_of(map);
  const types::Se2 path[] = {{std::nan(""), 1e300, 0.0}, {-HUGE_VAL, HUGE_VAL, 0.0}, {0, 0, 0}};
  draw_path(picture, map, path, kRed);
  EXPECT_EQ(picture.at(0, 3), kRed);
}

}  // namespace
}  // namespace topo::daemon

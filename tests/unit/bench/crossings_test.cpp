// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/crossings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace topo::bench {
namespace {

/// A corridor of 2 m along x from 0 to 20, and a hall of 10 m behind it.
sim::Raster corridor_and_hall() {
  sim::Raster free(0.1, {0.0, 0.0}, 320, 120);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 320; ++x)
      free.set(x, y, x < 200 ? (y >= 50 && y < 70) : (y >= 10 && y < 110 && x < 300));
  }
  return free;
}

std::vector<sim::Se2> drive(double from_m, double to_m) {
  std::vector<sim::Se2> way;
  const int n = 100;
  for (int i = 0; i <= n; ++i) way.push_back({from_m + (to_m - from_m) * i / n, 6.0, 0.0});
  return way;
}

std::vector<sim::Se2> joined(std::vector<std::vector<sim::Se2>> parts) {
  std::vector<sim::Se2> way;
  for (const auto& part : parts) way.insert(way.end(), part.begin(), part.end());
  return way;
}

TEST(Crossings, countsNarrowSquaresAlone) {
  const std::vector<std::vector<sim::Se2>> ways{drive(3.0, 28.0)};
  const Crossings crossings = count_crossings(corridor_and_hall(), ways);
  EXPECT_GE(crossings.squares, 9U);
  EXPECT_LE(crossings.squares, 11U) << "not those of the hall";
  EXPECT_EQ(crossings.over_twice, 0U);
}

TEST(Crossings, takesAWayThereAndBackForTwo) {
  const std::vector<std::vector<sim::Se2>> ways{joined({drive(3.0, 18.0), drive(18.0, 3.0)})};
  EXPECT_EQ(count_crossings(corridor_and_hall(), ways).over_twice, 0U);
}

TEST(Crossings, addsUpOverRobotsAndPasses) {
  const std::vector<std::vector<sim::Se2>> ways{joined({drive(3.0, 18.0), drive(18.0, 3.0)}),
                                                drive(3.0, 11.9)};
  const Crossings crossings = count_crossings(corridor_and_hall(), ways);
  EXPECT_GE(crossings.over_twice, 3U);
  EXPECT_LT(crossings.over_twice, crossings.squares);
}

TEST(Crossings, takesNoSwayAtABorderForAPass) {
  std::vector<sim::Se2> way;
  for (int i = 0; i < 50; ++i) way.push_back({i % 2 == 0 ? 9.9 : 10.1, 6.0, 0.0});
  const std::vector<std::vector<sim::Se2>> ways{way};
  const Crossings crossings = count_crossings(corridor_and_hall(), ways);
  EXPECT_EQ(crossings.squares, 2U);
  EXPECT_EQ(crossings.over_twice, 0U);
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/prepared_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/core/pipeline/drawn_map.hpp"

namespace topo::pipeline {
namespace {

using ::testing::ElementsAreArray;
using Rows = std::vector<std::string>;

TEST(CloseGaps, stripesBetweenBeamsAreNoFrontier) {
  grid::DenseMap map = drawn_map({"            ",  //
                                  "  ........  ",  //
                                  "            ",  //
                                  "  ........  ",  //
                                  "            ",  //
                                  "            "});
  close_gaps(map, 2);
  // Between the stripes all is free; beyond them nothing was seen.
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"            ",  //
                                                  "  ........  ",  //
                                                  "  ........  ",  //
                                                  "  ........  ",  //
                                                  "            ",  //
                                                  "            "}));
}

TEST(CloseGaps, aWallBetweenStaysClosedAndWideGapsStay) {
  const Rows rows{"              ",  //
                  "  ..#  ....   ",  //
                  "  ..#  ....   ",  //
                  "              ",  //
                  "              "};
  grid::DenseMap map = drawn_map(rows);
  close_gaps(map, 2);
  EXPECT_THAT(text_of(map), ElementsAreArray(rows));
}

TEST(FreeDisc, takesUnknownCellsOnly) {
  grid::DenseMap map = drawn_map({"     ", "  #  ", "     ", "     ", "     "}, 1.0);
  free_disc(map, {2.5, 2.5}, 1.1);
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"     ", "  #  ", " ... ", "  .  ", "     "}));
}

TEST(ApplyLimits, outsideAndKeepOutAreWalls) {
  grid::DenseMap map = drawn_map({"......", "......", "......", "......"}, 1.0);
  motion::AreaLimits limits;
  limits.keep_in = motion::Polygon{{1.0, 0.0}, {6.0, 0.0}, {6.0, 3.0}, {1.0, 3.0}};
  limits.keep_out.push_back({{3.0, 1.0}, {5.0, 1.0}, {5.0, 2.0}, {3.0, 2.0}});
  apply_limits(map, limits);
  EXPECT_THAT(text_of(map), ElementsAreArray(Rows{"######", "#.....", "#..##.", "#....."}));
}

TEST(LowerClearance, neverRaisesAndReachesAsFarAsTold) {
  const grid::DenseMap map = drawn_map(Rows(20, std::string(20, '.')), 0.1);
  std::vector<float> clearance(map.cells.size(), 0.3F);
  clearance[map.index({10, 10})] = 0.5F;
  lower_clearance(map, std::vector<types::Vector2>{map.centre_of({10, 12})}, 0.25, clearance);
  EXPECT_FLOAT_EQ(clearance[map.index({10, 12})], 0.0F);
  EXPECT_NEAR(clearance[map.index({10, 10})], 0.2, 1e-6);
  EXPECT_FLOAT_EQ(clearance[map.index({10, 8})], 0.3F);
  for (const float c : clearance) EXPECT_LE(c, 0.5F);
}

TEST(ConfirmedPoints, loneEchoesAreNoObstacles) {
  types::Scan scan;
  scan.beams = 9;
  scan.geometry.angle_min_rad = -0.04F;
  scan.geometry.angle_increment_rad = 0.01F;
  scan.range_m = {2.0F, 2.0F, 2.0F, 1.0F, 2.0F, 2.0F, types::kInvalid, 2.0F, 9.0F};
  const auto points = confirmed_points(scan, {0.0, 0.0, 0.0}, 5.0);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points.front().norm(), 2.0, 1e-6);
}

}  // namespace
}  // namespace topo::pipeline

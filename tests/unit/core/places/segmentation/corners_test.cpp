// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/corners.hpp"

#include <gtest/gtest.h>

#include "core/places/segmentation/box_counts.hpp"

namespace topo::places {
namespace {

constexpr double kCell_m = 0.05;

Region piece(double x0, double y0, double x1, double y1, std::vector<std::uint32_t> beside) {
  Region region;
  region.box = region.core = {{x0, y0}, {x1, y1}};
  region.cells = static_cast<std::uint32_t>((x1 - x0) * (y1 - y0) / (kCell_m * kCell_m));
  region.first = static_cast<std::uint32_t>(1000.0 * y0 + x0 + 100.0);
  region.clearance_m = 1.0F;
  region.sum = region.cells * types::Vector2(0.5 * (x0 + x1), 0.5 * (y0 + y1));
  for (const std::uint32_t other : beside) region.contacts.push_back({other, 40, 0, 0.0F, 1.0F, 40.0F});
  return region;
}

/// A corridor of 2 m along x, so long, the corner (number 1), and one of 8 m upwards from there; a spur in
/// the corner (number 3) hangs on it alone.
std::vector<Region> around_a_corner(double level_m) {
  return {piece(-level_m, 0.0, 0.0, 2.0, {1}), piece(0.0, 0.0, 2.0, 2.0, {0, 2, 3}),
          piece(0.0, 2.0, 2.0, 10.0, {1}), piece(1.9, 0.0, 2.0, 0.1, {1})};
}

TEST(Corners, GoToTheLongerCorridorWhoeverHadThem) {
  for (const std::uint32_t had : {0U, 2U}) {
    std::vector<std::uint32_t> longer_level{0, had, 2, had}, longer_upright = longer_level;
    EXPECT_EQ(settle_corners(around_a_corner(12.0), longer_level, kCell_m, {}), had == 2);
    EXPECT_EQ(longer_level, (std::vector<std::uint32_t>{0, 0, 2, 0}));
    EXPECT_EQ(settle_corners(around_a_corner(5.0), longer_upright, kCell_m, {}), had == 0);
    EXPECT_EQ(longer_upright, (std::vector<std::uint32_t>{0, 2, 2, 2}));
  }
}

TEST(Corners, OnlyWhatIsInLineWithBothIsGivenAway) {
  // The corner is the longer corridor's; the first piece of the other one is not in line with it.
  std::vector<Region> pieces = around_a_corner(12.0);
  pieces.push_back(piece(0.0, 10.0, 2.0, 18.0, {2}));
  pieces[2].contacts.push_back({4, 0, 40, 0.0F, 1.0F, 40.0F});
  std::vector<std::uint32_t> places{0, 0, 2, 0, 2};
  EXPECT_TRUE(settle_corners(pieces, places, kCell_m, {}));
  EXPECT_EQ(places, (std::vector<std::uint32_t>{0, 2, 2, 2, 2})) << "sixteen metres against twelve";
}

TEST(Corners, AWallBetweenKeepsThemApart) {
  std::vector<Region> pieces = around_a_corner(12.0);
  for (Contact& c : pieces[1].contacts) c.wall_m = 2.0F;
  std::vector<std::uint32_t> places{0, 2, 2, 2};
  EXPECT_FALSE(settle_corners(pieces, places, kCell_m, {}));
}

TEST(Joined, PlacesSumTheirPiecesAndKeepTheBorders) {
  const std::vector<Region> pieces = around_a_corner(12.0);
  const std::vector<Region> places = joined(pieces, {0, 0, 2, 0});
  EXPECT_EQ(places[0].cells, pieces[0].cells + pieces[1].cells + pieces[3].cells);
  EXPECT_EQ(places[0].box.min, types::Vector2(-12.0, 0.0));
  EXPECT_EQ(places[0].box.max, types::Vector2(2.0, 2.0));
  ASSERT_EQ(places[0].contacts.size(), 1U);
  EXPECT_EQ(places[0].contacts[0].other, 2U);
  EXPECT_EQ(places[0].contacts[0].upright, 40U);
  EXPECT_EQ(places[1].cells, 0U);
  EXPECT_EQ(places[2].contacts.at(0).other, 0U);
}

}  // namespace
}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/place_map.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "core/places/segmentation/box_counts.hpp"
#include "core/places/segmentation/segment_places.hpp"
#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

std::uint16_t label_at(const DenseMap& map, const PlaceMap& places, int x, int y) {
  return places.labels[map.index({x, y})];
}

/// A corridor of 20 x 2 m with two rooms of 5 x 5 m above it, each behind a door of 0.9 m, walls of 0.1 m.
DrawnMap office() {
  return DrawnMap(420, 160)
      .room(10, 10, 410, 50)
      .room(60, 52, 160, 152)
      .room(250, 52, 350, 152)
      .free(100, 50, 118, 52)
      .free(290, 50, 308, 52);
}

/// Corridors of 2 m that meet at a right angle, 12 m and 10 m long.
DrawnMap corner() {
  return DrawnMap(260, 220).room(10, 10, 250, 50).room(10, 10, 50, 210).free(10, 10, 250, 50);
}

std::vector<double> sorted_areas(const PlaceMap& places) {
  std::vector<double> areas;
  for (const Place& place : places.places) areas.push_back(place.area_m2);
  std::sort(areas.begin(), areas.end());
  return areas;
}

TEST(Places, RoomsAreApartFromTheirCorridorAtTheirDoors) {
  const DrawnMap drawn = office();
  const PlaceMap places = drawn.places();
  ASSERT_EQ(places.places.size(), 3U);
  const auto areas = sorted_areas(places);
  EXPECT_NEAR(areas[0], 25.0, 0.3);
  EXPECT_NEAR(areas[1], 25.0, 0.3);
  EXPECT_NEAR(areas[2], 40.0, 0.3);
  ASSERT_EQ(places.borders.size(), 2U);
  EXPECT_NEAR(places.borders[0].length_m, 0.9, 0.2);
  EXPECT_NE(label_at(drawn.map(), places, 109, 54), label_at(drawn.map(), places, 109, 47));
}

TEST(Places, OfACorridorThatTurnsAreItsArms) {
  const PlaceMap places = corner().places();
  ASSERT_EQ(places.places.size(), 2U);
  EXPECT_NEAR(sorted_areas(places)[0], 16.0, 4.5);  // the corner belongs to either
}

TEST(Places, OfACrossingAreOneCorridorAndTwoArms) {
  const DrawnMap drawn =
      DrawnMap(300, 300).room(10, 130, 290, 170).room(130, 10, 170, 290).free(10, 130, 290, 170);
  EXPECT_EQ(drawn.places().places.size(), 3U);
}

TEST(Places, OfACorridorThatWidensMuchAreTwo) {
  const DrawnMap drawn =
      DrawnMap(420, 120).room(200, 10, 410, 110).room(10, 40, 200, 80).free(195, 40, 205, 80);
  const PlaceMap places = drawn.places();
  ASSERT_EQ(places.places.size(), 2U);
  EXPECT_NE(label_at(drawn.map(), places, 20, 60), label_at(drawn.map(), places, 390, 60));
}

TEST(Places, FurnitureDoesNotDivideARoom) {
  DrawnMap drawn = DrawnMap(260, 180).room(10, 10, 250, 170);
  drawn.occupied(60, 60, 90, 75)
      .occupied(150, 90, 180, 110)
      .occupied(110, 20, 125, 35)
      .occupied(10, 120, 40, 128);
  EXPECT_EQ(drawn.places().places.size(), 1U);
}

TEST(Places, AWallThatIsSeenThroughDividesWithTheStore) {
  // Two rooms side by side; the wall between them is open in the occupancy grid for 3 of 5 m.
  DrawnMap drawn = DrawnMap(220, 120).room(10, 10, 210, 110).occupied(108, 10, 110, 50);
  EXPECT_EQ(drawn.places().places.size(), 1U);
  const std::vector<types::Segment> wall = {{{5.45, 0.5}, {5.45, 5.4}}};
  EXPECT_EQ(drawn.places(0.0, wall).places.size(), 2U);
}

TEST(Places, OfNothingAreNone) {
  const PlaceMap nothing = segment_places(DenseMap{}, {}, Skeleton{}, {}, 0.0);
  EXPECT_TRUE(nothing.places.empty());
  EXPECT_TRUE(nothing.labels.empty());
  EXPECT_TRUE(DrawnMap(30, 20).occupied(0, 0, 30, 20).places().places.empty());
  EXPECT_TRUE(DrawnMap(30, 20).free(12, 12, 13, 13).places().places.empty()) << "a speck";
}

TEST(Places, OfUniformFreeSpaceIsOne) {
  const PlaceMap places = DrawnMap(100, 60).free(0, 0, 100, 60).places();
  ASSERT_EQ(places.places.size(), 1U);
  EXPECT_NEAR(places.places[0].area_m2, 15.0, 1e-9);
  EXPECT_NEAR(places.places[0].centroid.x(), 2.5, 1e-9);
  EXPECT_NEAR(places.places[0].box.max.x(), 5.0, 1e-6);
}

TEST(Places, OfAPassageOneCellWideIsOneWhereThatIsWideEnough) {
  const DrawnMap drawn = DrawnMap(220, 9).free(5, 4, 215, 5);
  PlaceParams params;
  params.speck_width_m = 0.01;
  const auto clearance_m = drawn.clearance();
  EXPECT_EQ(segment_places(drawn.map(), clearance_m, skeletonise(drawn.map(), clearance_m), {}, 0.0, params)
                .places.size(),
            1U);
  EXPECT_TRUE(drawn.places().places.empty()) << "no robot fits there";
}

TEST(Places, OfAStripSeenThroughAPaneAreNone) {
  // 3 m by 0.3 m beside a room, as Freiburg 079 has behind its windows; one that joins the room belongs to
  // it.
  const auto with_strip = [](bool joined) {
    DrawnMap drawn = DrawnMap(160, 140).room(10, 10, 110, 110);
    return joined ? drawn.free(40, 110, 100, 116) : drawn.free(40, 116, 100, 122);
  };
  const PlaceMap apart = with_strip(false).places(), joined = with_strip(true).places();
  ASSERT_EQ(apart.places.size(), 1U);
  EXPECT_NEAR(apart.places[0].area_m2, 25.0, 1e-9);
  ASSERT_EQ(joined.places.size(), 1U);
  EXPECT_NEAR(joined.places[0].area_m2, 25.0 + 60 * 6 * 0.0025, 1e-9);
}

TEST(Places, OfAPassageThatARobotFitsIntoIsOneAlsoByItself) {
  EXPECT_EQ(DrawnMap(220, 20).free(5, 5, 215, 15).places().places.size(), 1U);
}

TEST(Places, MoveWithTheMap) {
  const DenseMap map = office().map();
  DenseMap moved = map;
  moved.box.min.x += 1000;
  moved.box.max.x += 1000;
  moved.box.min.y -= 333;
  moved.box.max.y -= 333;
  const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const Skeleton skeleton = skeletonise(map, clearance_m);
  EXPECT_EQ(segment_places(map, clearance_m, skeleton, {}, 0.0).labels,
            segment_places(moved, clearance_m, skeleton, {}, 0.0).labels);
}

TEST(Places, TurnWithTheMap) {
  for (const auto& [drawn, corner_m2] : {std::pair(office(), 0.3), std::pair(corner(), 4.0)}) {
    DenseMap map = drawn.map();
    const auto areas = sorted_areas(drawn.places());
    for (int quarter = 0; quarter < 3; ++quarter) {
      map = turned(map);
      const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
      const PlaceMap places = segment_places(map, clearance_m, skeletonise(map, clearance_m), {}, 0.0);
      const auto turned_areas = sorted_areas(places);
      ASSERT_EQ(turned_areas.size(), areas.size());
      for (std::size_t k = 0; k < areas.size(); ++k)
        EXPECT_NEAR(turned_areas[k], areas[k], 0.1 * areas[k] + corner_m2);
    }
  }
}

TEST(Places, DoNotDependOnTheNumbersOfNodes) {
  const DenseMap map = office().map();
  const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  const Skeleton skeleton = skeletonise(map, clearance_m);
  const auto expected = segment_places(map, clearance_m, skeleton, {}, 0.0).labels;
  Skeleton other = skeleton;
  std::reverse(other.nodes.begin(), other.nodes.end());
  std::reverse(other.edges.begin(), other.edges.end());
  const auto last = static_cast<std::uint32_t>(other.nodes.size() - 1);
  for (SkeletonEdge& edge : other.edges) {
    edge.a = last - edge.a;
    edge.b = last - edge.b;
  }
  EXPECT_EQ(segment_places(map, clearance_m, other, {}, 0.0).labels, expected);
}

/// What must hold of any map.
TEST(Places, CoverFreeSpaceOnceAndAreConnected) {
  EXPECT_TRUE(rc::check([] {
    DrawnMap drawn(90, 70);
    drawn.free(2, 2, 88, 68);
    const int count = *rc::gen::inRange(0, 25);
    for (int k = 0; k < count; ++k) {
      const int x = *rc::gen::inRange(0, 88), y = *rc::gen::inRange(0, 68);
      drawn.fill(x, y, std::min(x + *rc::gen::inRange(1, 30), 90), std::min(y + *rc::gen::inRange(1, 9), 70),
                 *rc::gen::element(CellState::kOccupied, CellState::kUnknown));
    }
    const DenseMap& map = drawn.map();
    const PlaceMap places = drawn.places(0.3);
    std::vector<double> area_m2(places.places.size(), 0.0);
    const CompassFrame frame(0.3);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const std::uint16_t label = places.labels[i];
      RC_ASSERT(label <= places.places.size());
      RC_ASSERT(label == 0 || map.cells[i] == CellState::kFree);
      if (label == 0) continue;
      area_m2[label - 1U] += 0.0025;
      RC_ASSERT(places.places[label - 1U].box.contains(frame.from_map(map.centre_of(map.cell(i)))));
    }
    for (std::size_t p = 0; p < area_m2.size(); ++p) {
      RC_ASSERT(std::abs(area_m2[p] - places.places[p].area_m2) < 1e-9);
      RC_ASSERT(count_components(map, true, [&](std::size_t i) { return places.labels[i] == p + 1; }) == 1);
    }
    for (const PlaceBorder& border : places.borders)
      RC_ASSERT(border.a < border.b && border.b < places.places.size() && border.length_m > 0.0);
  }));
}

}  // namespace
}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/openings.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "core/goals/frontiers.hpp"
#include "core/places/segmentation/box_counts.hpp"
#include "tests/unit/core/goals/scene.hpp"

namespace topo::goals {
namespace {

constexpr std::array kSides{Side::kEast, Side::kNorth, Side::kWest, Side::kSouth};

/// One place with a box of whole centimetres in a frame that is turned anyhow.
places::PlaceMap one_box() {
  places::PlaceMap map;
  map.compass_rad = 0.01 * *rc::gen::inRange(-78, 79);
  const types::Vector2 min = random_point(5.0);
  const types::Vector2 size(0.01 * *rc::gen::inRange(1, 900), 0.01 * *rc::gen::inRange(1, 900));
  map.places.push_back({{min, min + size}, min + 0.5 * size, size.x() * size.y(), 1.0F});
  return map;
}

TEST(Openings, ASidesMidpointIsNearestToThatSide) {
  EXPECT_TRUE(rc::check([] {
    const places::PlaceMap map = one_box();
    for (const Side side : kSides) RC_ASSERT(nearest_side(map, 1, side_midpoint(map, 1, side)) == side);
  }));
}

TEST(Openings, OppositeMidpointsAreABoxApart) {
  EXPECT_TRUE(rc::check([] {
    const places::PlaceMap map = one_box();
    const types::Rectangle& box = map.places[0].box;
    const types::Vector2 centre = places::CompassFrame(map.compass_rad).to_map(0.5 * (box.min + box.max));
    const auto at = [&](Side side) { return side_midpoint(map, 1, side); };
    const types::Vector2 across = at(Side::kEast) - at(Side::kWest), up = at(Side::kNorth) - at(Side::kSouth);
    RC_ASSERT(std::abs(across.norm() - (box.max.x() - box.min.x())) < 1e-9);
    RC_ASSERT(std::abs(up.norm() - (box.max.y() - box.min.y())) < 1e-9);
    RC_ASSERT(std::abs(across.dot(up)) < 1e-9);
    RC_ASSERT(across.x() * up.y() - across.y() * up.x() > 0.0);  // north is left of east
    RC_ASSERT((0.5 * (at(Side::kEast) + at(Side::kWest)) - centre).norm() < 1e-9);
    RC_ASSERT((0.5 * (at(Side::kNorth) + at(Side::kSouth)) - centre).norm() < 1e-9);
    RC_ASSERT((at(Side::kNone) - centre).norm() < 1e-9);
  }));
}

TEST(Openings, TheNearestSideIsTheOneWithTheLeastWayOut) {
  EXPECT_TRUE(rc::check([] {
    const places::PlaceMap map = one_box();
    const types::Rectangle& box = map.places[0].box;
    const types::Vector2 share(0.01 * *rc::gen::inRange(0, 101), 0.01 * *rc::gen::inRange(0, 101));
    const types::Vector2 p = box.min + share.cwiseProduct(box.max - box.min);
    const auto way_out_m = [&](Side side) {
      switch (side) {
        case Side::kEast:
          return box.max.x() - p.x();
        case Side::kNorth:
          return box.max.y() - p.y();
        case Side::kWest:
          return p.x() - box.min.x();
        default:
          return p.y() - box.min.y();
      }
    };
    const Side nearest = nearest_side(map, 1, places::CompassFrame(map.compass_rad).to_map(p));
    for (const Side side : kSides) RC_ASSERT(way_out_m(nearest) <= way_out_m(side) + 1e-9);
  }));
}

TEST(Openings, AreTheFrontiersOfPlacesInTheirOrder) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene(random_room(90));
    GoalParams params;
    params.opening_min_m = 0.05 * *rc::gen::inRange(1, 20);
    const auto openings = find_openings(scene.input(), params);
    const auto key = [](const Opening& o) { return std::tuple(o.place, o.side, o.middle); };
    RC_ASSERT(std::ranges::is_sorted(openings, {}, key));
    std::size_t of_places = 0;
    for (const Frontier& frontier : find_frontiers(scene.map, params.opening_min_m)) {
      const auto label = [&](std::uint32_t i) { return scene.places.labels[i]; };
      const bool has_place = std::ranges::any_of(frontier.cells, [&](auto i) { return label(i) != 0; });
      const auto at = std::ranges::find(openings, frontier.cells, &Opening::cells);
      RC_ASSERT((at != openings.end()) == has_place);
      if (!has_place) continue;
      ++of_places;
      RC_ASSERT(at->width_m == frontier.width_m && at->width_m >= params.opening_min_m - 1e-6);
      RC_ASSERT(at->middle == middle_of(scene.map, frontier.cells));
      RC_ASSERT(label(at->middle) == 0 || at->place == label(at->middle));
      RC_ASSERT(std::ranges::any_of(frontier.cells, [&](auto i) { return label(i) == at->place; }));
      const types::Vector2 middle = scene.map.centre_of(scene.map.cell(at->middle));
      RC_ASSERT(at->side == nearest_side(scene.places, at->place, middle));
    }
    RC_ASSERT(of_places == openings.size());
  }));
}

}  // namespace
}  // namespace topo::goals

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/goals/standing_places.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "core/goals/filters.hpp"
#include "tests/unit/core/goals/scene.hpp"
#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::goals {
namespace {

using places::DrawnMap;
using Served = std::vector<std::uint32_t>;

struct Floor {
  explicit Floor(const DrawnMap& drawn)
      : map(drawn.map()), clearance_m(drawn.clearance()), skeleton(places::skeletonise(map, clearance_m)) {}

  /// Of prospects that stand at these points of the map.
  [[nodiscard]] std::vector<StandingPlace> places_for(const std::vector<types::Vector2>& stands) const {
    std::vector<Prospect> prospects;
    for (const types::Vector2& p : stands) prospects.push_back({p, map.cell_at(p), 0.5});
    const places::PlaceMap no_places;
    return standing_places({map, clearance_m, skeleton, no_places, {}, {}}, prospects, {});
  }

  grid::DenseMap map;
  std::vector<float> clearance_m;
  places::Skeleton skeleton;
};

/// A corridor of 2 m, 14 m long, y from 1 m to 3 m.
DrawnMap closed_corridor() { return DrawnMap(320, 160).room(20, 20, 300, 60); }

TEST(StandingPlaces, TheOpeningsOwnComeFirst) {
  const auto places = Floor(closed_corridor()).places_for({{3.0, 2.5}, {12.0, 2.5}});
  ASSERT_EQ(places.size(), 2U) << "nobody sees both from 3 m";
  for (std::uint32_t k = 0; k < 2; ++k) {
    EXPECT_EQ(places[k].serves, Served({k}));
    EXPECT_FALSE(places[k].is_shared);
  }
}

TEST(StandingPlaces, OnTheAxisBetweenTwoOpeningsBothAreServed) {
  const Floor floor(closed_corridor());
  const auto places = floor.places_for({{5.0, 2.5}, {9.5, 1.5}});
  ASSERT_GT(places.size(), 2U);
  EXPECT_EQ(places[0].serves, Served({0})) << "4.6 m apart";
  for (std::size_t k = 2; k < places.size(); ++k) {
    EXPECT_EQ(places[k].serves, Served({0, 1}));
    EXPECT_TRUE(places[k].is_shared);
    EXPECT_NEAR(places[k].p_map.x(), 7.25, 0.75);
    EXPECT_NEAR(places[k].p_map.y(), 2.0, 0.1) << "the axis";
    EXPECT_NEAR(places[k].away_m, 2.35, 0.2);
  }
}

TEST(StandingPlaces, NobodySeesThroughAWall) {
  const Floor floor(DrawnMap(320, 200).room(20, 20, 300, 60).room(20, 62, 300, 102));
  for (const StandingPlace& place : floor.places_for({{7.0, 2.5}, {7.0, 3.6}}))
    EXPECT_EQ(place.serves.size(), 1U);
}

TEST(StandingPlaces, HaveRoomForTheRobot) {
  // An axis through a gap of 0.5 m.
  const Floor floor(closed_corridor().occupied(150, 20, 152, 35).occupied(150, 45, 152, 60));
  const auto places = floor.places_for({{6.5, 2.0}, {8.6, 2.0}});
  ASSERT_GT(places.size(), 2U);
  for (const StandingPlace& place : places)
    EXPECT_GE(floor.clearance_m[floor.map.index(floor.map.cell_at(place.p_map))],
              static_cast<float>(GoalParams{}.robot_radius_m));
}

TEST(StandingPlaces, ServeAllThatIsNearAndInSight) {
  EXPECT_TRUE(rc::check([] {
    const Scene scene(random_room(90));
    GoalParams params;
    params.in_sight_m = 0.1 * *rc::gen::inRange(1, 40) + 0.01;  // no distance between cells
    std::vector<Prospect> prospects;
    for (int k = *rc::gen::inRange(0, 10); k > 0; --k) {
      const auto i = *rc::gen::inRange<std::size_t>(0, scene.map.cells.size());
      prospects.push_back({scene.map.centre_of(scene.map.cell(i)), scene.map.cell(i), 0.5});
    }
    const auto places = standing_places(scene.input(), prospects, params);
    RC_ASSERT(places.size() >= prospects.size());
    for (std::uint32_t p = 0; p < places.size(); ++p) {
      const StandingPlace& place = places[p];
      Served serves;
      double sum_m = 0.0;
      for (std::uint32_t k = 0; k < prospects.size(); ++k) {
        const double away_m = (scene.map.centre_of(prospects[k].stand) - place.p_map).norm();
        const bool in_sight = away_m <= params.in_sight_m &&
                              sees(scene.map, prospects[k].stand, scene.map.cell_at(place.p_map));
        if (p != k && !in_sight) continue;
        serves.push_back(k);
        sum_m += away_m;
      }
      RC_ASSERT(place.serves == serves);
      RC_ASSERT(std::abs(place.away_m * static_cast<double>(serves.size()) - sum_m) < 1e-9);
      RC_ASSERT(place.is_shared == (p >= prospects.size()));
      RC_ASSERT(!place.is_shared || serves.size() > 1);
    }
  }));
}

}  // namespace
}  // namespace topo::goals

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/grid/wavefront.hpp"
#include "core/places/segmentation/segment_places.hpp"
#include "daemon/mapfile/outlines.hpp"
#include "daemon/mapfile/overview.hpp"
#include "daemon/mapfile/places_geojson.hpp"

namespace topo::daemon {
namespace {

using grid::CellState;
using Json = nlohmann::json;

/// A room of 4 x 3 m with a pillar of 0.5 m, a wall, an open goal and a rejected one.
analysis::Analysis sample() {
  analysis::Analysis a;
  a.map.box = {{-3, -3}, {85, 65}};
  a.map.cells.assign(89U * 69U, CellState::kUnknown);
  for (int y = -2; y < 62; ++y) {
    for (int x = -2; x < 82; ++x) {
      const bool wall = x < 0 || y < 0 || x >= 80 || y >= 60, pillar = x >= 30 && x < 40 && y >= 30 && y < 40;
      a.map.cells[a.map.index({x, y})] = wall || pillar ? CellState::kOccupied : CellState::kFree;
    }
  }
  const std::vector<float> clearance_m = analysis::clearance_of(a);
  a.skeleton = places::skeletonise(a.map, clearance_m);
  a.places = places::segment_places(a.map, clearance_m, a.skeleton, {}, 0.0);
  a.walls = {{{0.0, 0.0}, {4.0, 0.0}}};
  goals::Goal goal;
  goal.p_map = {3.0, 2.5};
  goal.place = 1;
  a.goals.goals = {goal};
  goal.p_map = {0.5, 0.5};
  goal.verdict = goals::Verdict::kVisited;
  a.goals.rejected = {goal};
  return a;
}

double signed_area(const Json& ring) {
  double twice = 0.0;
  for (std::size_t k = 0; k + 1 < ring.size(); ++k)
    twice += ring[k][0].get<double>() * ring[k + 1][1].get<double>() -
             ring[k + 1][0].get<double>() * ring[k][1].get<double>();
  return 0.5 * twice;
}

TEST(PlacesGeojson, HoldsPlacesWallsAndGoals) {
  const analysis::Analysis a = sample();
  const Json json = Json::parse(places_geojson(a, a.goals.goals));
  EXPECT_EQ(json["type"], "FeatureCollection");
  EXPECT_EQ(json["frame"], "map");
  ASSERT_EQ(json["features"].size(), 4U);
  const Json& place = json["features"][0];
  EXPECT_EQ(place["type"], "Feature");
  EXPECT_EQ(place["geometry"]["type"], "Polygon");
  const Json& rings = place["geometry"]["coordinates"];
  ASSERT_EQ(rings.size(), 2U);
  EXPECT_EQ(rings[0].size(), 5U) << "corners only, the first one again";
  EXPECT_EQ(rings[0].front(), rings[0].back());
  EXPECT_NEAR(signed_area(rings[0]), 12.0, 1e-9);
  EXPECT_NEAR(signed_area(rings[1]), -0.25, 1e-9);
  EXPECT_NEAR(place["properties"]["area_m2"].get<double>(), 11.75, 1e-9);
  EXPECT_EQ(json["features"][1]["geometry"]["type"], "LineString");
  EXPECT_EQ(json["features"][2]["properties"]["verdict"], "accepted");
  EXPECT_EQ(json["features"][2]["properties"]["number"], 1);
  EXPECT_EQ(json["features"][2]["geometry"]["coordinates"], Json::parse("[3.0, 2.5]"));
  EXPECT_EQ(json["features"][3]["properties"]["verdict"], "a robot was there already");
}

TEST(PlacesGeojson, IsInTheFrameThatItsOriginIsGivenIn) {
  const analysis::Analysis a = sample();
  const Json here = Json::parse(places_geojson(a, a.goals.goals)),
             there = Json::parse(places_geojson(a, a.goals.goals, {-10.0, 2.5}));
  EXPECT_EQ(there["features"][2]["geometry"]["coordinates"], Json::parse("[-7.0, 5.0]"));
  EXPECT_EQ(there["features"][1]["geometry"]["coordinates"], Json::parse("[[-10.0, 2.5], [-6.0, 2.5]]"));
  const Json &ring = here["features"][0]["geometry"]["coordinates"][0],
             &moved = there["features"][0]["geometry"]["coordinates"][0];
  for (std::size_t k = 0; k < ring.size(); ++k) {
    EXPECT_NEAR(moved[k][0].get<double>(), ring[k][0].get<double>() - 10.0, 1e-9);
    EXPECT_NEAR(moved[k][1].get<double>(), ring[k][1].get<double>() + 2.5, 1e-9);
  }
}

TEST(PlacesGeojson, OfNothingIsAnEmptyCollection) {
  EXPECT_TRUE(Json::parse(places_geojson({}, {}))["features"].empty());
}

TEST(Outlines, PartCellsThatTouchOverACorner) {
  grid::DenseMap map;
  map.box = {{0, 0}, {6, 6}};
  map.cells.assign(49U, CellState::kUnknown);
  std::vector<std::uint16_t> labels(49U, 0);
  for (const grid::CellIndex c : {grid::CellIndex{1, 1}, {2, 2}, {4, 4}, {4, 5}}) labels[map.index(c)] = 1;
  EXPECT_EQ(parts_of(outlines_of(map, labels, 1)[0]).size(), 3U);
  // Two holes that touch, and a bay that is closed over a corner, are rings of their own.
  labels.assign(49U, 0);
  for (int y = 1; y < 6; ++y)
    for (int x = 1; x < 6; ++x) labels[map.index({x, y})] = 1;
  labels[map.index({2, 2})] = labels[map.index({3, 3})] = 0;
  labels[map.index({5, 5})] = labels[map.index({4, 4})] = 0;
  const auto parts = parts_of(outlines_of(map, labels, 1)[0]);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].size(), 4U) << "the outline and three holes of a cell";
}

TEST(Outlines, EncloseEveryCellOfTheirLabelOnce) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map;
    map.box = {{-1, -1}, {20, 16}};
    map.cells.assign(22U * 18U, CellState::kUnknown);
    std::vector<std::uint16_t> labels(map.cells.size(), 0);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 20; ++x) labels[map.index({x, y})] = *rc::gen::inRange<std::uint16_t>(0, 3);
    }
    const auto outlines = outlines_of(map, labels, 2);
    for (std::uint16_t label = 1; label <= 2; ++label) {
      std::int64_t twice = 0;
      for (const Ring& ring : outlines[label - 1U]) {
        std::set<std::pair<int, int>> corners;
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const grid::CellIndex a = ring[k], b = ring[(k + 1) % ring.size()];
          RC_ASSERT(corners.emplace(a.x, a.y).second);
          RC_ASSERT((a.x == b.x) != (a.y == b.y));
          twice += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
        }
      }
      RC_ASSERT(twice == 2 * std::count(labels.begin(), labels.end(), label));
    }
  }));
}

/// Cells of each region of marked cells that hang together over sides, in rising order.
std::vector<std::int64_t> region_sizes(const grid::DenseMap& map, std::vector<std::uint16_t> labels) {
  std::vector<std::int64_t> sizes;
  for (std::size_t seed = 0; seed < labels.size(); ++seed) {
    if (labels[seed] == 0) continue;
    std::vector<std::size_t> region{seed};
    labels[seed] = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
      const grid::CellIndex at = map.cell(region[i]);
      for (const grid::CellIndex& by : grid::kNeighbours) {
        const std::size_t next = map.index({at.x + by.x, at.y + by.y});
        if (labels[next] == 0 || (by.x != 0 && by.y != 0)) continue;
        labels[next] = 0;
        region.push_back(next);
      }
    }
    sizes.push_back(static_cast<std::int64_t>(region.size()));
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

TEST(Outlines, ByPartsAreThoseOfTheRegionsThatHangTogether) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map;
    map.box = {{-1, -1}, {20, 16}};
    map.cells.assign(22U * 18U, CellState::kUnknown);
    std::vector<std::uint16_t> labels(map.cells.size(), 0);
    const int share = *rc::gen::inRange(1, 10);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 20; ++x) labels[map.index({x, y})] = *rc::gen::inRange(0, 10) < share ? 1 : 0;
    std::vector<std::int64_t> areas;
    for (const std::vector<Ring>& part : parts_of(outlines_of(map, labels, 1)[0])) {
      std::int64_t twice = 0;
      for (const Ring& ring : part) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const grid::CellIndex a = ring[k], b = ring[(k + 1) % ring.size()];
          twice += std::int64_t{a.x} * b.y - std::int64_t{b.x} * a.y;
        }
      }
      areas.push_back(twice / 2);
    }
    std::sort(areas.begin(), areas.end());
    RC_ASSERT(areas == region_sizes(map, labels));
  }));
}

TEST(Overview, ShowsWhatItSaysItShows) {
  const analysis::Analysis a = sample();
  const types::Se2 path[] = {{1.0, 1.0, 0.0}, {2.0, 1.0, 0.0}};
  const Picture picture = overview_of(a, path, a.goals.goals);
  const auto count = [&](auto&& like) {
    return std::count_if(picture.pixels().begin(), picture.pixels().end(), like);
  };
  EXPECT_EQ(picture.width() % 3, 0) << "a small map is drawn larger";
  EXPECT_GT(count([](Rgb c) { return c == Rgb{0, 130, 50}; }), 100) << "the open goal";
  EXPECT_EQ(count([](Rgb c) { return c == Rgb{240, 140, 20}; }), 9) << "the rejected one";
  EXPECT_GT(count([](Rgb c) { return c == Rgb{30, 60, 220}; }), 60) << "trajectory";
  EXPECT_GT(count([](Rgb c) { return c == Rgb{220, 30, 30}; }), 200) << "wall";
  EXPECT_GT(count([](Rgb c) { return c == Rgb{0, 0, 0}; }), 1000) << "occupied";
  EXPECT_GT(count([](Rgb c) { return c.r != c.g || c.g != c.b; }), picture.width() * picture.height() / 2)
      << "the place's colour";
}

TEST(Overview, FramesTheRegionsInWhichTheMapIsDoubted) {
  const analysis::Analysis a = sample();
  const auto doubted = [&](std::span<const slam::RevisitRegion> regions) {
    const Picture picture = overview_of(a, {}, a.goals.goals, regions);
    return std::count(picture.pixels().begin(), picture.pixels().end(), Rgb{230, 0, 120});
  };
  const slam::RevisitRegion region{{2.5, 2.5}, 2000, 600};
  EXPECT_EQ(doubted({}), 0);
  EXPECT_GT(doubted({&region, 1}), 50);
}

TEST(Overview, OfNothingIsOnePixel) {
  const Picture picture = overview_of({}, {}, {});
  EXPECT_EQ(picture.width(), 1);
  EXPECT_EQ(picture.height(), 1);
}

TEST(Overview, PosesFarOutsideDoNotHurt) {
  const analysis::Analysis a = sample();
  const types::Se2 path[] = {{1e9, -1e9, 0.0}, {NAN, 1.0, 0.0}, {2.0, 1.0, 0.0}};
  EXPECT_GT(overview_of(a, path, {}).width(), 1);
}

}  // namespace
}  // namespace topo::daemon

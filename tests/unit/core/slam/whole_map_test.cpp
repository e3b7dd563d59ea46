// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/whole_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <random>

#include "core/slam/make_keyframe.hpp"
#include "tests/unit/core/slam/graph_fixture.hpp"
#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

/// Keyframes of two rooms at their true poses: the map is the world.
Session session_of(const std::vector<Se2>& poses, unsigned seed = 1) {
  std::mt19937 random(seed);
  Session session;
  session.poses = poses;
  for (const Se2& pose : poses) {
    const testing::View view = testing::view_of(mocks::two_rooms(), pose, 0.01, random);
    session.keyframes.push_back(make_keyframe({}, view.cloud, view.points, {}, {}, {}));
  }
  return session;
}

const std::vector<Se2> kRound{{1.5, 3.6, 0.0}, {1.5, 3.6, 2.1}, {1.5, 3.6, -2.1},
                              {4.5, 3.6, 0.0}, {4.5, 3.6, 2.1}, {4.5, 3.6, -2.1},
                              {9.0, 4.5, 0.0}, {9.0, 4.5, 2.1}, {9.0, 4.5, -2.1}};

TEST(Apart, IsByDistanceOrByHeading) {
  const WholeSearch search{.apart_m = 0.7, .apart_rad = 0.3};
  EXPECT_FALSE(apart({}, {}, search));
  EXPECT_FALSE(apart({}, {0.69, 0.0, 0.29}, search));
  EXPECT_TRUE(apart({}, {0.5, 0.5, 0.0}, search));
  EXPECT_TRUE(apart({}, {0.0, 0.0, 0.31}, search));
  EXPECT_FALSE(apart({0.0, 0.0, 3.1}, {0.0, 0.0, -3.1}, search)) << "both look back";
}

TEST(Apart, IsTheSameFromEitherSideAndInAnyFrame) {
  const WholeSearch search{.apart_m = 8.0, .apart_rad = 1.5};
  std::mt19937 random(1);
  int count = 0;
  for (int k = 0; k < 300; ++k) {
    const Se2 a = testing::random_pose(random), b = testing::random_pose(random);
    const Se2 frame = testing::random_pose(random);
    const bool expected = apart(a, b, search);
    EXPECT_EQ(apart(b, a, search), expected);
    EXPECT_EQ(apart(frame * a, frame * b, search), expected);
    EXPECT_FALSE(apart(a, a, search));
    count += expected ? 1 : 0;
  }
  EXPECT_LT(count, 300) << "some are one place";
}

/// A cell of 5 cm and the quarter that a normal points to.
using CellAndQuarter = std::tuple<int, int, int>;

CellAndQuarter cell_and_quarter(const SurfelMap& map, const Point& position, const Point& normal) {
  const Point cell = (position - map.origin()) / 0.05F;
  const bool is_steep = std::abs(normal.y()) > std::abs(normal.x());
  const float along = is_steep ? normal.y() : normal.x();
  return {static_cast<int>(cell.x()), static_cast<int>(cell.y()),
          (is_steep ? 0 : 2) + (along > 0.0F ? 0 : 1)};
}

TEST(ThinnedMap, HasOneSurfelOfEachCellAndSide) {
  const Session session = session_of(kRound);
  const SurfelMap map = thinned_map(session, {6.0, 4.0}, 10.0, 0.35, 0.05);
  std::map<CellAndQuarter, int> thinned, all;
  for (const Surfel& surfel : map.surfels()) ++thinned[cell_and_quarter(map, surfel.position, surfel.normal)];
  for (const auto& [cell, count] : thinned) EXPECT_EQ(count, 1);
  SurfelMap whole(0.35);
  whole.reset(Point(6.0F, 4.0F), 10.0);
  for (std::size_t i = 0; i < kRound.size(); ++i)
    whole.add(session.keyframes[i]->content.surfels(), kRound[i]);
  for (const Surfel& surfel : whole.surfels()) ++all[cell_and_quarter(map, surfel.position, surfel.normal)];
  EXPECT_LT(thinned.size(), whole.surfels().size()) << "places that were seen twice";
  EXPECT_EQ(thinned.size(), all.size()) << "no cell of the map is lost";
}

TEST(ThinnedMap, IsTheSameHoweverOftenTheWayWasDriven) {
  Session once = session_of(kRound), often = once;
  for (int k = 0; k < 3; ++k) {
    often.keyframes.insert(often.keyframes.end(), once.keyframes.begin(), once.keyframes.end());
    often.poses.insert(often.poses.end(), once.poses.begin(), once.poses.end());
  }
  const SurfelMap a = thinned_map(once, {6.0, 4.0}, 10.0, 0.35, 0.05),
                  b = thinned_map(often, {6.0, 4.0}, 10.0, 0.35, 0.05);
  ASSERT_GT(a.surfels().size(), 100U);
  EXPECT_TRUE(std::ranges::equal(a.surfels(), b.surfels(), [](const Surfel& x, const Surfel& y) {
    return x.position == y.position && x.normal == y.normal && x.planar == y.planar;
  }));
}

TEST(ThinnedMap, KeepsBothFacesOfAThinWall) {
  Session session;
  KeyframeContent content;
  const Point at(1.02F, 0.02F);
  for (const Point& normal : {Point(1.0F, 0.0F), Point(-1.0F, 0.0F), Point(0.9F, 0.1F), Point(0.0F, 1.0F)})
    content.surfels.push_back({at, normal, true});
  content.surfels.push_back({Point(50.0F, 0.0F), Point(1.0F, 0.0F), true});  // outside the window
  auto keyframe = std::make_shared<Keyframe>();
  keyframe->content = CodedContent(std::move(content));
  session.keyframes.push_back(std::move(keyframe));
  session.poses.emplace_back();
  EXPECT_EQ(thinned_map(session, {0.0, 0.0}, 5.0, 0.35, 0.05).surfels().size(), 3U);
  session.poses.front().theta_rad = std::numbers::pi / 4.0;  // two quarters become others
  EXPECT_GE(thinned_map(session, {0.0, 0.0}, 5.0, 0.35, 0.05).surfels().size(), 3U);
  session.poses.front().x_m = 100.0;
  EXPECT_TRUE(thinned_map(session, {0.0, 0.0}, 5.0, 0.35, 0.05).surfels().empty());
}

TEST(WholeMap, OfNothingOrOfTooMuchThereIsNone) {
  EXPECT_FALSE(WholeMap::of({}, {}, {}, {}));
  const Session session = session_of({{3.0, 3.0, 0.0}});
  EXPECT_TRUE(WholeMap::of(session, {}, {}, {}));
  // The world is 12 m wide, and 2 m are left on either side.
  EXPECT_FALSE(WholeMap::of(session, {.width_max_m = 9.0}, {}, {}));
  EXPECT_TRUE(WholeMap::of(session, {.width_max_m = 17.0}, {}, {}));
}

TEST(WholeMap, TheBestPeakIsWhereTheScanWasTaken) {
  std::mt19937 random(3);
  const auto map = WholeMap::of(session_of(kRound), {}, {}, {});
  ASSERT_TRUE(map);
  for (const Se2& truth : {Se2{2.5, 3.0, 0.8}, Se2{8.5, 5.5, -2.0}, Se2{6.0, 2.0, 3.0}}) {
    const testing::View view = testing::view_of(mocks::two_rooms(), truth, 0.01, random);
    const std::vector<Peak> peaks = map->peaks(view.points, view.cloud.sensor);
    ASSERT_FALSE(peaks.empty());
    EXPECT_LE(peaks.size(), 5U) << "the best and its rivals";
    EXPECT_LT(distance_m(peaks.front().match.T_map_base, truth), 0.05);
    EXPECT_LT(std::abs(types::wrap_angle(peaks.front().match.T_map_base.theta_rad - truth.theta_rad)), 0.02);
    for (std::size_t k = 0; k < peaks.size(); ++k) {
      EXPECT_LE(peaks[k].evidence, peaks[k].match.response) << "contradictions weigh against a place";
      if (k > 0) {
        EXPECT_GE(peaks[k - 1].evidence, peaks[k].evidence) << "the best comes first";
      }
    }
  }
}

TEST(WholeMap, AtAPoseTheEvidenceIsOfTheRefinedOne) {
  std::mt19937 random(4);
  const auto map = WholeMap::of(session_of(kRound), {}, {}, {});
  ASSERT_TRUE(map);
  const Se2 truth{3.0, 3.0, 0.4};
  const testing::View view = testing::view_of(mocks::two_rooms(), truth, 0.01, random);
  const Peak peak = map->at(view.points, view.cloud.sensor, {3.08, 2.93, 0.43});
  EXPECT_LT(testing::difference(peak.match.T_map_base, truth), 0.02);
  EXPECT_GT(peak.evidence, 0.85);
  EXPECT_LT(map->contradiction(view.points, truth), 0.02);
  const Se2 wrong{3.0, 4.0, 2.0};
  EXPECT_GT(map->contradiction(view.points, wrong), 0.1) << "walls would stand in the room";
  EXPECT_LT(map->at(view.points, view.cloud.sensor, wrong).evidence, 0.5);
  EXPECT_TRUE(map->peaks({}, {}).empty());
}

}  // namespace
}  // namespace topo::slam

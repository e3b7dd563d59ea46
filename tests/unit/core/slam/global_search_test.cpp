// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/global_search.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

const SearchParams kCoarse{0.2, 0.3, 60, 0};

/// A map with room everywhere.
struct Place {
  explicit Place(const SurfelMap& map) : levels(map, kCoarse), room(levels.pyramid(), map.width_m()) {
    const auto width = static_cast<float>(map.width_m());
    for (float y = 0.0F; y < width; y += 0.5F)
      room.add_ray(map.origin() + Point(0.0F, y), map.origin() + Point(width, y));
    room.close();
  }
  PlaceLevels levels;
  StandingRoom room;
};

SurfelMap rooms(std::mt19937& random) {
  SurfelMap map(0.35);
  map.reset(Point(5.0F, 4.0F), 8.0);
  for (const types::Se2& pose : {types::Se2{3.0, 3.0, 0.0}, {8.0, 3.5, 2.0}})
    map.add(testing::view_of(mocks::two_rooms(), pose, 0.0, random).surfels, pose);
  return map;
}

double score_at(const LikelihoodPyramid& pyramid, const std::vector<Point>& points, const types::Se2& pose) {
  const double c = std::cos(pose.theta_rad), s = std::sin(pose.theta_rad), cell = pyramid.cell_m();
  const int x = static_cast<int>(std::floor((pose.x_m - static_cast<double>(pyramid.origin().x())) / cell));
  const int y = static_cast<int>(std::floor((pose.y_m - static_cast<double>(pyramid.origin().y())) / cell));
  int sum = 0;
  for (const Point& p : points) {
    const double px = static_cast<double>(p.x()), py = static_cast<double>(p.y());
    sum += pyramid.at(0, x + static_cast<int>(std::floor((c * px - s * py) / cell + 0.5)),
                      y + static_cast<int>(std::floor((s * px + c * py) / cell + 0.5)));
  }
  return sum / (255.0 * static_cast<double>(points.size()));
}

bool is_apart(const types::Se2& a, const types::Se2& b, const PeakSearch& wanted) {
  return (a.translation() - b.translation()).norm() >= wanted.apart_m ||
         std::abs(types::wrap_angle(a.theta_rad - b.theta_rad)) >= wanted.apart_rad;
}

/// Every pose that the search stands for is tried.
std::vector<double> peaks_by_trying(const Place& place, const std::vector<Point>& points,
                                    const PeakSearch& wanted) {
  const LikelihoodPyramid& pyramid = place.levels.pyramid();
  const int turns = static_cast<int>(std::ceil(2.0 * std::numbers::pi * 10.0 / pyramid.cell_m()));
  std::vector<SearchHit> all;
  for (int r = 0; r < turns; ++r) {
    for (int y = 0; y < place.room.width(); ++y) {
      for (int x = 0; x < place.room.width(); ++x) {
        const types::Se2 pose{static_cast<double>(pyramid.origin().x()) + (x + 0.5) * pyramid.cell_m(),
                              static_cast<double>(pyramid.origin().y()) + (y + 0.5) * pyramid.cell_m(),
                              2.0 * std::numbers::pi * r / turns - std::numbers::pi};
        const double score = score_at(pyramid, points, pose);
        if (score >= wanted.score_min) all.push_back({pose, score});
      }
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<SearchHit> peaks;
  for (const SearchHit& hit : all) {
    const bool stands = std::all_of(peaks.begin(), peaks.end(), [&](const SearchHit& peak) {
      return is_apart(hit.T_map_base, peak.T_map_base, wanted);
    });
    if (stands && peaks.size() < wanted.count_max && hit.score >= wanted.ratio * all.front().score)
      peaks.push_back(hit);
  }
  std::vector<double> scores;
  scores.reserve(peaks.size());
  for (const SearchHit& peak : peaks) scores.push_back(peak.score);
  return scores;
}

TEST(SearchEverywhere, PeaksAreThoseOfTryingEveryPose) {
  std::mt19937 random(7);
  const Place place(rooms(random));
  PeakSearch wanted;
  wanted.ratio = 0.6;
  for (const types::Se2& truth : {types::Se2{3.4, 2.6, 0.8}, {8.5, 5.0, -2.0}, {5.5, 1.5, 3.0}}) {
    std::vector<Point> points;
    for (const Point& p : testing::view_of(mocks::two_rooms(), truth, 0.02, random).points) {
      if (points.size() < 60 && random() % 4 == 0) points.push_back(p);
    }
    const auto peaks = search_everywhere(place.levels, place.room, points, wanted, kCoarse);
    const std::vector<double> tried = peaks_by_trying(place, points, wanted);
    ASSERT_EQ(peaks.size(), tried.size());
    ASSERT_FALSE(peaks.empty());
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      EXPECT_DOUBLE_EQ(peaks[i].score, tried[i]);
      EXPECT_DOUBLE_EQ(score_at(place.levels.pyramid(), points, peaks[i].T_map_base), peaks[i].score);
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_TRUE(is_apart(peaks[i].T_map_base, peaks[k].T_map_base, wanted));
    }
  }
}

/// What fits in more places than are remembered still has as many peaks as were asked for.
TEST(SearchEverywhere, AScanThatFitsAlmostEverywhereHasPeaks) {
  SurfelMap map(0.35);
  map.reset(Point::Zero(), 25.0);
  std::vector<Surfel> walls;  // 21 of 40 m: blocks of places by the hundred thousand
  for (int row = -10; row <= 10; ++row) {
    for (int i = -200; i <= 200; ++i)
      walls.push_back(
          {Point(0.1F * static_cast<float>(i), 2.0F * static_cast<float>(row)), Point::UnitY(), true});
  }
  map.add(walls, {});
  const PlaceLevels levels(map, {0.1, 0.15, 100, 0});
  StandingRoom room(levels.pyramid(), map.width_m());
  const auto width = static_cast<float>(map.width_m());
  for (float y = 0.0F; y < width; y += 0.5F)
    room.add_ray(map.origin() + Point(0.0F, y), map.origin() + Point(width, y));
  room.close();
  const std::vector<Point> one{Point(2.0F, 0.0F)};
  const PeakSearch wanted;
  const auto peaks = search_everywhere(levels, room, one, wanted, {0.1, 0.15, 100, 0});
  ASSERT_EQ(peaks.size(), wanted.count_max);
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    EXPECT_EQ(peaks[i].score, peaks.front().score);
    EXPECT_DOUBLE_EQ(score_at(levels.pyramid(), one, peaks[i].T_map_base), peaks[i].score);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_TRUE(is_apart(peaks[i].T_map_base, peaks[k].T_map_base, wanted));
  }
}

TEST(SearchEverywhere, WhereThereIsNoRoomNobodyIsLookedFor) {
  std::mt19937 random(9);
  const SurfelMap map = rooms(random);
  const PlaceLevels levels(map, kCoarse);
  StandingRoom room(levels.pyramid(), map.width_m());
  room.close();
  const auto points = testing::view_of(mocks::two_rooms(), {3.4, 2.6, 0.8}, 0.0, random).points;
  EXPECT_TRUE(search_everywhere(levels, room, points, {}, kCoarse).empty());
  const Place place(map);
  EXPECT_FALSE(search_everywhere(place.levels, place.room, points, {}, kCoarse).empty());
  EXPECT_TRUE(search_everywhere(place.levels, place.room, {}, {}, kCoarse).empty());
}

}  // namespace
}  // namespace topo::slam

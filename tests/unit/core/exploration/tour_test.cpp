// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/exploration/tour.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <numeric>

#include "core/types/se2.hpp"

namespace topo::exploration {
namespace {

using types::Vector2;

TourGoals in_the_plane(const std::vector<Vector2>& points, const std::vector<double>& worth) {
  TourGoals goals(points.size());
  goals.worth = worth;
  for (std::size_t i = 0; i < points.size(); ++i) {
    goals.from_start_m[i] = points[i].norm();
    for (std::size_t j = 0; j < points.size(); ++j) goals.between(i, j) = (points[i] - points[j]).norm();
  }
  return goals;
}

TourGoals arbitrary_goals(int most) {
  const int count = *rc::gen::inRange(0, most + 1);
  std::vector<Vector2> points;
  std::vector<double> worth;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(0.1 * *rc::gen::inRange(-300, 300), 0.1 * *rc::gen::inRange(-300, 300));
    worth.push_back(*rc::gen::inRange(0, 7));
  }
  return in_the_plane(points, worth);
}

TEST(Tour, visitsEveryGoalOnceAndBeginsWhereItIsTold) {
  EXPECT_TRUE(rc::check([] {
    const TourGoals goals = arbitrary_goals(15);
    const double share = 0.1 * *rc::gen::inRange(0, 11);
    std::optional<std::size_t> first;
    if (goals.count > 0 && *rc::gen::arbitrary<bool>())
      first = *rc::gen::inRange<std::size_t>(0, goals.count);
    Tour tour = cheap_tour(goals, share, first);
    RC_ASSERT(tour == cheap_tour(goals, share, first));
    if (first) RC_ASSERT(tour.front() == *first);
    Tour all(goals.count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::sort(tour.begin(), tour.end());
    RC_ASSERT(tour == all);
  }));
}

TEST(Tour, noSwapOfTwoGoalsAndNoPieceTurnedRoundMakesItCheaper) {
  EXPECT_TRUE(rc::check([] {
    const TourGoals goals = arbitrary_goals(12);
    const double share = 0.1 * *rc::gen::inRange(0, 11);
    const Tour best = cheap_tour(goals, share);
    const double best_m = tour_cost_m(goals, best, share);
    for (std::size_t i = 0; i < best.size(); ++i) {
      for (std::size_t j = i + 1; j < best.size(); ++j) {
        Tour turned = best;
        std::reverse(turned.begin() + static_cast<std::ptrdiff_t>(i),
                     turned.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        RC_ASSERT(best_m <= tour_cost_m(goals, turned, share) + 1e-5);
      }
    }
  }));
}

TEST(Tour, ofFewGoalsIsHardlyDearerThanTheBestOfAll) {
  EXPECT_TRUE(rc::check([] {
    const TourGoals goals = arbitrary_goals(6);
    const double share = 0.1 * *rc::gen::inRange(0, 11);
    Tour tour(goals.count);
    std::iota(tour.begin(), tour.end(), std::size_t{0});
    double best_m = tour_cost_m(goals, tour, share);
    while (std::next_permutation(tour.begin(), tour.end()))
      best_m = std::min(best_m, tour_cost_m(goals, tour, share));
    const double found_m = tour_cost_m(goals, cheap_tour(goals, share), share);
    RC_ASSERT(found_m >= best_m - 1e-9);
    RC_ASSERT(found_m <= 1.5 * best_m + 1e-9);
  }));
}

TEST(Tour, aGapOnTheWayComesFirstOneBehindWaits) {
  // A corridor to the right that leads on, a corner to the left.
  const TourGoals corner_behind = in_the_plane({{-3.0, 0.0}, {8.0, 0.0}}, {0.2, 6.0});
  EXPECT_EQ(cheap_tour(corner_behind, 0.0), (Tour{1, 0})) << "by worth";
  EXPECT_EQ(cheap_tour(corner_behind, 1.0), (Tour{0, 1})) << "by length: the corner is never nearer";
  const TourGoals corner_ahead = in_the_plane({{3.0, 0.5}, {8.0, 0.0}}, {0.2, 6.0});
  for (const double share : {0.4, 1.0}) EXPECT_EQ(cheap_tour(corner_ahead, share), (Tour{0, 1})) << share;
}

TEST(Tour, costMixesMeanWayAndLengthByTheirShares) {
  const TourGoals goals = in_the_plane({{1.0, 0.0}, {3.0, 0.0}}, {1.0, 3.0});
  EXPECT_DOUBLE_EQ(tour_cost_m(goals, {0, 1}, 1.0), 3.0);
  EXPECT_DOUBLE_EQ(tour_cost_m(goals, {0, 1}, 0.0), (1.0 + 3.0 * 3.0) / 4.0);
  EXPECT_DOUBLE_EQ(tour_cost_m(goals, {1, 0}, 0.5), 0.5 * 5.0 + 0.5 * (3.0 * 3.0 + 5.0) / 4.0);
  EXPECT_DOUBLE_EQ(tour_cost_m(in_the_plane({{2.0, 0.0}}, {0.0}), {0}, 0.0), 2.0) << "worth nothing";
  EXPECT_EQ(tour_cost_m(TourGoals(0), {}, 0.5), 0.0);
}

}  // namespace
}  // namespace topo::exploration

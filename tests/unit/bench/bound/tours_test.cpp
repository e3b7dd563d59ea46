// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/bound/tours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/sim/random.hpp"
#include "tests/sim/shapes.hpp"

namespace topo::bench::bound {
namespace {

Lengths between(const std::vector<sim::Vector2>& points) {
  Lengths lengths(points.size(), std::vector<double>(points.size(), 0.0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < points.size(); ++k) lengths[i][k] = (points[i] - points[k]).norm();
  }
  return lengths;
}

std::vector<sim::Vector2> scattered(std::size_t n, std::uint64_t seed) {
  sim::Random random(seed);
  std::vector<sim::Vector2> points;
  for (std::size_t i = 0; i < n; ++i)
    points.emplace_back(random.uniform(0.0, 20.0), random.uniform(0.0, 20.0));
  return points;
}

double longest(const Lengths& lengths, const std::vector<std::size_t>& starts, const Tours& tours) {
  double out = 0.0;
  for (std::size_t r = 0; r < tours.size(); ++r)
    out = std::max(out, open_length_m(lengths, starts[r], tours[r]));
  return out;
}

/// By trying every order.
double best_open_m(const Lengths& lengths, std::vector<std::size_t> stops) {
  std::sort(stops.begin(), stops.end());
  double best = HUGE_VAL;
  do {
    best = std::min(best, open_length_m(lengths, 0, stops));
  } while (std::next_permutation(stops.begin(), stops.end()));
  return best;
}

TEST(Tours, visitEveryStopOnce) {
  const Lengths lengths = between(scattered(32, 5));
  std::vector<std::size_t> stops;
  for (std::size_t i = 2; i < 32; ++i) stops.push_back(i);
  const Tours tours = share_out(lengths, {0, 1}, stops);
  ASSERT_EQ(tours.size(), 2U);
  std::set<std::size_t> seen;
  for (const auto& tour : tours) seen.insert(tour.begin(), tour.end());
  EXPECT_EQ(seen.size(), 30U);
  EXPECT_EQ(tours[0].size() + tours[1].size(), 30U);
}

TEST(Tours, areNearTheBestOfOneRobot) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Lengths lengths = between(scattered(8, seed));
    const std::vector<std::size_t> stops{1, 2, 3, 4, 5, 6, 7};
    const double best_m = best_open_m(lengths, stops);
    const double found_m = longest(lengths, {0}, share_out(lengths, {0}, stops));
    EXPECT_GE(found_m, best_m - 1e-9);
    EXPECT_LE(found_m, 1.12 * best_m) << "seed " << seed;
  }
}

TEST(Tours, areBalancedBetweenTwo) {
  const Lengths lengths = between(scattered(42, 9));
  std::vector<std::size_t> stops;
  for (std::size_t i = 1; i < 42; ++i) stops.push_back(i);
  const double one_m = longest(lengths, {0}, share_out(lengths, {0}, stops));
  const double two_m = longest(lengths, {0, 0}, share_out(lengths, {0, 0}, stops));
  EXPECT_LT(two_m, 0.7 * one_m);
}

TEST(Tours, joinNodesByTheSmallestTree) {
  const Lengths lengths = between({{0.0, 0.0}, {3.0, 0.0}, {3.0, 4.0}, {10.0, 0.0}});
  EXPECT_NEAR(spanning_tree_m(lengths, {0, 1, 2, 3}), 3.0 + 4.0 + 7.0, 1e-12);
  EXPECT_DOUBLE_EQ(spanning_tree_m(lengths, {2}), 0.0);
}

}  // namespace
}  // namespace topo::bench::bound

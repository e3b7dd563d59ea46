// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/loop_candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "core/slam/graph_links.hpp"

namespace topo::slam {
namespace {

/// A path of straight half-metre steps.
struct Path {
  std::vector<types::Se2> poses{{}};
  std::vector<Edge> edges;
  void go(double x_m, double y_m) {
    const types::Se2 target{x_m, y_m, 0.0};
    const types::Se2 start = poses.back();
    const double length = distance_m(start, target);
    const int steps = static_cast<int>(std::round(length / 0.5));
    for (int i = 1; i <= steps; ++i) {
      poses.push_back(types::interpolate(start, target, static_cast<double>(i) / steps));
      Edge edge;
      edge.from = poses.size() - 2;
      edge.to = poses.size() - 1;
      edge.T_from_to = poses[edge.from].inverse() * poses[edge.to];
      edges.push_back(edge);
    }
  }
};

const LoopParams kLoopParams;

/// Where the path's last pose may have been before.
std::vector<LoopRun> runs_at_end(const Path& path) {
  const std::size_t last = path.poses.size() - 1;
  std::vector<std::size_t> way(path.poses.size());
  std::iota(way.begin(), way.end(), 0U);
  GraphLinks links{GraphParams{}.turn_on_spot_m};
  for (const Edge& edge : path.edges) links.add(edge);
  const auto distances = links.distances_m(path.poses.size(), last);
  const std::size_t end = end_of_other_visits(path.poses, way, last, kLoopParams);
  return find_loop_runs(path.poses, distances, last, way, end, kLoopParams);
}

TEST(FindLoopRuns, TheRecentPathIsNoOtherVisit) {
  Path path;
  path.go(10.0, 0.0);
  EXPECT_TRUE(runs_at_end(path).empty());
}

TEST(FindLoopRuns, ComingBackAfterALoopFindsTheBeginning) {
  Path path;
  path.go(15.0, 0.0);
  path.go(15.0, 15.0);
  path.go(0.0, 15.0);
  path.go(0.0, 1.0);
  const auto runs = runs_at_end(path);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].nearest, 0U);
  EXPECT_NEAR(runs[0].window.half_m, kLoopParams.search_floor_m + kLoopParams.drift_per_m * 59.0 * 1.1, 0.15);
}

TEST(FindLoopRuns, ARunReachesAsFarAlongTheWayAsItsWindow) {
  Path path;
  path.go(100.0, 0.0);
  path.go(100.0, 40.0);
  path.go(40.0, 40.0);
  path.go(40.0, 0.5);
  const auto runs = runs_at_end(path);
  ASSERT_FALSE(runs.empty());
  EXPECT_NEAR(path.poses[runs[0].nearest].x_m, 40.0, 0.01);
  EXPECT_GT(runs[0].window.half_m, 4.5) << "further than the keyframes that a run has at least";
  EXPECT_LE(path.poses[runs[0].first].x_m, 40.0 - runs[0].window.half_m);
  EXPECT_GE(path.poses[runs[0].last].x_m, 40.0 + runs[0].window.half_m);
}

TEST(FindLoopRuns, AClosureShortensTheWayAndNarrowsTheSearch) {
  Path path;
  path.go(15.0, 0.0);
  path.go(15.0, 15.0);
  path.go(0.0, 15.0);
  path.go(0.0, 1.0);
  Edge closure;
  closure.from = 0;
  closure.to = path.poses.size() - 2;
  closure.T_from_to = path.poses[closure.from].inverse() * path.poses[closure.to];
  path.edges.push_back(closure);
  const auto runs = runs_at_end(path);
  ASSERT_FALSE(runs.empty());
  EXPECT_LT(runs[0].window.half_m, 0.4);
}

TEST(FindLoopRuns, SeparateVisitsAreSeparateRunsNearestFirst) {
  Path path;
  path.go(20.0, 0.0);
  path.go(20.0, 3.0);
  path.go(0.0, 3.0);
  path.go(0.0, 20.0);
  path.go(10.0, 20.0);
  path.go(10.0, 1.9);
  const auto runs = runs_at_end(path);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_NEAR(path.poses[runs[0].nearest].y_m, 3.0, 1e-9);
  EXPECT_NEAR(path.poses[runs[1].nearest].y_m, 0.0, 1e-9);
}

std::vector<std::size_t> nodes_in_order(std::size_t count) {
  std::vector<std::size_t> way(count);
  std::iota(way.begin(), way.end(), std::size_t{0});
  return way;
}

/// A walk that turns a little at each step and comes by the same places now and then.
std::vector<types::Se2> wandering(std::size_t steps, std::mt19937& random) {
  std::normal_distribution<double> turn(0.0, 0.4);
  std::vector<types::Se2> poses{{}};
  while (poses.size() < steps) poses.push_back(poses.back() * types::Se2{0.4, 0.0, turn(random)});
  return poses;
}

TEST(EndOfOtherVisits, LeavesAsMuchWayBetweenAsTheGap) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const auto poses = wandering(120, random);
    const auto way = nodes_in_order(poses.size());
    for (std::size_t at = 0; at < poses.size(); at += 7) {
      // A place is of another visit when the way from it is at least the gap.
      std::size_t expected = 0;
      for (std::size_t place = 0; place < at; ++place) {
        double metres = 0.0;
        for (std::size_t i = place; i < at; ++i) metres += distance_m(poses[i], poses[i + 1]);
        if (metres >= kLoopParams.chain_gap_m) expected = place + 1;
      }
      // Sums of the same steps from the other end differ by rounding.
      const std::size_t end = end_of_other_visits(poses, way, at, kLoopParams);
      EXPECT_LE(std::max(end, expected) - std::min(end, expected), 1U) << seed << ": " << at;
      EXPECT_LE(end, at);
    }
  }
}

TEST(FindLoopRuns, AreWithinTheWayAndReachTheirNearestPlace) {
  std::size_t count = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    std::mt19937 random(seed);
    const auto poses = wandering(150, random);
    const auto way = nodes_in_order(poses.size());
    const std::size_t node = poses.size() - 1, end = 100;
    std::vector<double> distances(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) distances[i] = 0.4 * static_cast<double>(node - i);
    const auto runs = find_loop_runs(poses, distances, node, way, end, kLoopParams);
    EXPECT_LE(runs.size(), static_cast<std::size_t>(kLoopParams.groups_max));
    bool any_near = false;
    for (std::size_t i = 0; i < end; ++i)
      any_near |= distance_m(poses[i], poses[node]) <= kLoopParams.radius_m + kLoopParams.search_floor_m;
    EXPECT_TRUE(!any_near || !runs.empty()) << seed;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const LoopRun& run = runs[k];
      ASSERT_LE(run.first, run.nearest);
      ASSERT_LE(run.nearest, run.last);
      ASSERT_LT(run.last, end);
      EXPECT_DOUBLE_EQ(run.distance_m, distance_m(poses[run.nearest], poses[node]));
      EXPECT_LE(run.distance_m, kLoopParams.radius_m + run.window.half_m);
      EXPECT_LE(run.window.half_m, kLoopParams.search_max_m);
      EXPECT_GE(run.window.half_m, kLoopParams.search_floor_m);
      EXPECT_LE(run.window.half_rad, kLoopParams.search_max_rad);
      EXPECT_GE(run.window.half_rad, kLoopParams.search_floor_rad);
      if (k == 0) {
        for (std::size_t i = 0; i < end; ++i)
          EXPECT_LE(run.distance_m, distance_m(poses[i], poses[node])) << "the first is the nearest of all";
      } else {
        EXPECT_LE(runs[k - 1].distance_m, run.distance_m);
      }
    }
    count += runs.size();
    EXPECT_TRUE(find_loop_runs(poses, distances, node, way, 0, kLoopParams).empty());
  }
  EXPECT_GT(count, 30U);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/loop_candidates.hpp"

#include <gtest/gtest.h>

#include <numeric>

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
  GraphLinks links;
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

}  // namespace
}  // namespace topo::slam

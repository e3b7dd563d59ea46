// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/closure_span.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

constexpr double kContradicted = 30.0;

std::vector<Se2> along_x(std::size_t count) {
  std::vector<Se2> poses;
  for (std::size_t i = 0; i < count; ++i) poses.push_back({static_cast<double>(i), 0.0, 0.0});
  return poses;
}

std::vector<std::size_t> all_of(std::size_t count) {
  std::vector<std::size_t> way(count);
  for (std::size_t i = 0; i < count; ++i) way[i] = i;
  return way;
}

Edge closure(std::span<const Se2> poses, std::size_t from, std::size_t to, const Se2& error = {}) {
  Edge edge = testing::measured(poses, from, to, error);
  edge.information = Eigen::Matrix3d::Identity();
  edge.robust = true;
  return edge;
}

TEST(ClosureSpan, ASpannedStepLiesBetweenTheEndsOfAClosure) {
  EXPECT_TRUE(rc::check("against each closure by itself", [] {
    const std::size_t count = *rc::gen::inRange<std::size_t>(2, 30);
    const auto poses = along_x(count);
    const auto place = rc::gen::inRange<std::size_t>(0, count);
    std::vector<Edge> edges;
    for (int k = *rc::gen::inRange(0, 4); k > 0; --k) edges.push_back(closure(poses, *place, *place));
    const auto spanned = spanned_by_closures(edges, poses, all_of(count), kContradicted);
    for (std::size_t i = 1; i < count; ++i) {
      bool lies_between = false;
      for (const Edge& edge : edges) {
        const auto [first, last] = std::minmax(edge.from, edge.to);
        lies_between = lies_between || (first < i && i <= last);
      }
      RC_ASSERT(spanned[i] == lies_between);
    }
  }));
}

TEST(ClosureSpan, AContradictedClosureSpansNothing) {
  const auto poses = along_x(5);
  EXPECT_TRUE(spanned_by_closures(std::vector{closure(poses, 0, 4)}, poses, all_of(5), kContradicted)[2]);
  const std::vector wrong{closure(poses, 0, 4, {9.0, 0.0, 0.0})};
  EXPECT_FALSE(spanned_by_closures(wrong, poses, all_of(5), kContradicted)[2]);
}

TEST(ClosureSpan, TheStepsOfAWayAreThoseBetweenItsNeighbours) {
  const auto poses = along_x(6);
  const std::vector<std::size_t> way{0, 2, 3, 5};  // the others are a team-mate's
  const std::vector edges{testing::measured(poses, 0, 2), testing::measured(poses, 3, 2),
                          testing::measured(poses, 3, 4), testing::measured(poses, 2, 5),
                          closure(poses, 3, 5)};
  const auto steps = way_steps(edges, poses, way, kContradicted);
  ASSERT_EQ(steps.size(), 2U) << "neither a mate's, nor one over a place between, nor a closure";
  EXPECT_EQ(steps[0].place, 1U);
  EXPECT_EQ(steps[1].edge, &edges[1]);
  EXPECT_EQ(steps[1].place, 2U);
  EXPECT_FALSE(steps[1].spanned);
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/known_starts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using types::Se2;

TEST(KnownStarts, AreOneRelationWhoeverSaysIt) {
  std::mt19937 random(1);
  const std::vector<KeyframeId> ids{{0, 0, 0}, {0, 0, 5}, {0, 3, 5}, {2, 0, 0}, {2, 1, 0}, {7, 0, 9}};
  for (std::size_t a = 0; a < ids.size(); ++a) {
    for (std::size_t b = 0; b < ids.size(); ++b) {
      if (a == b) continue;
      const Se2 start_a = testing::random_pose(random), start_b = testing::random_pose(random);
      const auto one = known_starts(ids[a], start_a, ids[b], start_b);
      const auto other = known_starts(ids[b], start_b, ids[a], start_a);
      EXPECT_EQ(one.first, other.first);
      EXPECT_EQ(one.second.T_from_to, other.second.T_from_to) << "to the bit";
      EXPECT_EQ(one.second.information, other.second.information);
      EXPECT_LT(one.first.first, one.first.second);
      // Who stands at the lower one's start and goes the relation is at the other's.
      const auto& [from, to] = a < b ? std::pair(start_a, start_b) : std::pair(start_b, start_a);
      EXPECT_LT(testing::difference(from * one.second.T_from_to, to), 1e-12);
    }
  }
}

TEST(KnownStarts, DoNotDependOnTheFrameTheyAreSaidIn) {
  std::mt19937 random(2);
  for (int k = 0; k < 30; ++k) {
    const Se2 a = testing::random_pose(random), b = testing::random_pose(random);
    const Se2 frame = testing::random_pose(random);
    const Se2 here = known_starts({1, 0}, a, {2, 0}, b).second.T_from_to;
    const Se2 there = known_starts({1, 0}, frame * a, {2, 0}, frame * b).second.T_from_to;
    EXPECT_LT(testing::difference(here, there), 1e-9);
  }
}

TEST(KnownStarts, AreBelievedAsFarAsPeopleAre) {
  const Relation relation = known_starts({1, 0}, {}, {2, 0}, {3.0, 0.0, 0.0}, {0.5, 0.1}).second;
  EXPECT_TRUE(relation.robust);
  EXPECT_NEAR(relation.information(0, 0), 4.0, 1e-12);
  EXPECT_NEAR(relation.information(1, 1), 4.0, 1e-12);
  EXPECT_NEAR(relation.information(2, 2), 100.0, 1e-9);
  EXPECT_EQ(relation.information, Eigen::Matrix3d(relation.information.diagonal().asDiagonal()));
  const auto [key, by_default] = known_starts({1, 0}, {}, {2, 0}, {3.0, 0.0, 0.0});
  EXPECT_TRUE(check_relation({{1, 0}, key, by_default})) << "others take it";
}

}  // namespace
}  // namespace topo::slam

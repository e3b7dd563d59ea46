// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/assignment.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/core/team/generators.hpp"

namespace topo::team {
namespace {

using testing::arbitrary_table;

std::size_t busy(const Assignment& assignment) {
  return static_cast<std::size_t>(
      std::count_if(assignment.begin(), assignment.end(), [](const auto& goal) { return goal.has_value(); }));
}

TEST(AssignClusters, givesNoGoalTwiceAndNoneOutOfReach) {
  EXPECT_TRUE(rc::check("sound, with and without clusters", [] {
    const CostTable table = arbitrary_table();
    RC_ASSERT(testing::is_sound(table, assign_clusters(table)));
    RC_ASSERT(testing::is_sound(table, assign_clusters(table, false)));
  }));
}

TEST(AssignClusters, nobodyWaitsForWhatNobodyElseTakes) {
  EXPECT_TRUE(rc::check("greedy is maximal over single goals", [] {
    const CostTable table = arbitrary_table();
    const Assignment assignment = assign_clusters(table, false);
    std::vector<bool> taken(table.goals().size(), false);
    for (const auto& goal : assignment) {
      if (goal) taken[*goal] = true;
    }
    for (std::size_t r = 0; r < assignment.size(); ++r) {
      for (std::size_t g = 0; g < taken.size() && !assignment[r]; ++g)
        RC_ASSERT(taken[g] || std::isinf(table.cost_m(r, g)));
    }
  }));
}

TEST(AssignClusters, theCheapestPairOfAllIsTaken) {
  EXPECT_TRUE(rc::check("greedy", [] {
    const CostTable table = arbitrary_table();
    double least_m = HUGE_VAL;
    for (std::size_t r = 0; r < table.robots().size(); ++r) {
      for (std::size_t g = 0; g < table.goals().size(); ++g) least_m = std::min(least_m, table.cost_m(r, g));
    }
    const Assignment assignment = assign_clusters(table);
    double taken_m = HUGE_VAL;
    for (std::size_t r = 0; r < assignment.size(); ++r) {
      if (assignment[r]) taken_m = std::min(taken_m, table.cost_m(r, *assignment[r]));
    }
    RC_ASSERT(taken_m == least_m);
    RC_ASSERT(busy(assignment) <= table.able_robots());
  }));
}

TEST(AssignClusters, aRobotAloneHasOneClusterOfAllGoals) {
  const CostTable alone({4}, {{5.0, 0.0}, {40.0, 0.0}, {41.0, 0.0}});
  EXPECT_EQ(clusters_of(alone, true), (std::vector<std::size_t>{0, 0, 0}));
  EXPECT_EQ(clusters_of(alone, false), (std::vector<std::size_t>{0, 0, 0}));
  const CostTable pair({4, 5}, {{5.0, 0.0}, {40.0, 0.0}, {41.0, 0.0}});
  const std::vector<std::size_t> single = clusters_of(pair, false);
  EXPECT_EQ((std::set<std::size_t>{single.begin(), single.end()}.size()), 3U);
}

TEST(AssignClusters, oneGoalSendsOneRobotAndTheOtherWaits) {  // figure 8 (a)
  CostTable table({2, 3}, {{20.0, 0.0}});
  table.cost_m(0, 0) = 18.0;
  table.cost_m(1, 0) = 20.0;
  EXPECT_EQ(assign_clusters(table), (Assignment{0, std::nullopt}));
}

TEST(AssignClusters, robotsGoToDifferentWingsAlthoughBothAreNearestToOne) {
  // Two goals in the near wing, two in the far one: without clusters both robots would stay in the near wing.
  CostTable table({1, 2}, {{5.0, 0.0}, {6.0, 0.0}, {40.0, 0.0}, {41.0, 0.0}});
  for (std::size_t r = 0; r < 2; ++r) {
    for (std::size_t g = 0; g < 4; ++g) table.cost_m(r, g) = table.goals()[g].x() + static_cast<double>(r);
  }
  EXPECT_EQ(assign_clusters(table), (Assignment{0, 2}));
  EXPECT_EQ(assign_clusters(table, false), (Assignment{0, 1}));
}

TEST(AssignClusters, areOfEssentialGoalsAndGapsJoinTheNearestOne) {
  // Nine gaps in the near wing would split it in two; the building goes on in both wings.
  std::vector<types::Vector2> goals{{0.0, 0.0}, {40.0, 0.0}};
  for (int i = 1; i <= 9; ++i) goals.emplace_back(i < 5 ? 0.0 : 10.0, 1.0 * i);
  CostTable table({1, 2}, goals);
  for (std::size_t goal = 2; goal < goals.size(); ++goal) table.set_essential(goal, false);
  for (std::size_t goal = 0; goal < goals.size(); ++goal)
    table.cost_m(0, goal) = table.cost_m(1, goal) = goals[goal].norm() + 1.0;
  const std::vector<std::size_t> cluster = clusters_of(table);
  EXPECT_NE(cluster[0], cluster[1]);
  for (std::size_t goal = 2; goal < goals.size(); ++goal) EXPECT_EQ(cluster[goal], cluster[0]) << goal;
  table.set_essential(1, false);
  const std::vector<std::size_t> of_all = clusters_of(table);
  EXPECT_NE(of_all[1], of_all[0]) << "fewer essential goals than robots: of all goals";
}

TEST(AssignClusters, aRobotThatCanGoNowhereIsNoCluster) {
  CostTable table({1, 2}, {{5.0, 0.0}, {40.0, 0.0}, {41.0, 0.0}});
  table.cost_m(1, 0) = 7.0;
  table.cost_m(1, 1) = 6.0;
  EXPECT_EQ(table.able_robots(), 1U);
  EXPECT_EQ(assign_clusters(table), (Assignment{std::nullopt, 1})) << "one cluster, and its nearest goal";
  EXPECT_EQ(assign_clusters(CostTable({1, 2}, {})), (Assignment{std::nullopt, std::nullopt}));
}

}  // namespace
}  // namespace topo::team

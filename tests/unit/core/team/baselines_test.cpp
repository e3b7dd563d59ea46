// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/baselines.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/generators.hpp"

namespace topo::team {
namespace {

using testing::arbitrary_table;

const InSight kOpen = [](std::size_t, std::size_t) { return true; };
const InSight kWalled = [](std::size_t, std::size_t) { return false; };

CostTable table_of(const std::vector<std::vector<double>>& costs_m, std::vector<types::Vector2> goals) {
  std::vector<std::uint16_t> robots;
  for (std::uint16_t id = 0; id < costs_m.size(); ++id) robots.push_back(id);
  CostTable table(std::move(robots), std::move(goals));
  for (std::size_t r = 0; r < costs_m.size(); ++r) {
    for (std::size_t g = 0; g < costs_m[r].size(); ++g) table.cost_m(r, g) = costs_m[r][g];
  }
  return table;
}

const std::vector<types::Vector2> kThree{{0.0, 0.0}, {3.0, 0.0}, {40.0, 0.0}};

TEST(Baselines, giveNobodyAGoalOutOfReach) {
  EXPECT_TRUE(rc::check("sound", [] {
    const CostTable table = arbitrary_table();
    RC_ASSERT(testing::is_sound(table, assign_in_turn(table)));
    RC_ASSERT(testing::is_sound(table, assign_by_utility(table, kOpen, 30.0), true));
    RC_ASSERT(testing::is_sound(table, assign_min_pos(table), true));
  }));
}

TEST(Baselines, leaveNobodyIdleWhoHasAGoalOfItsOwnInReach) {
  EXPECT_TRUE(rc::check("MinPos and the utilities make nobody wait", [] {
    const CostTable table = arbitrary_table();
    const Assignment ranked = assign_min_pos(table), useful = assign_by_utility(table, kOpen, 30.0);
    for (std::size_t r = 0; r < ranked.size(); ++r) {
      bool any = false;
      for (std::size_t g = 0; g < table.goals().size(); ++g) any = any || table.cost_m(r, g) < HUGE_VAL;
      RC_ASSERT(ranked[r].has_value() == any);
      RC_ASSERT(useful[r].has_value() == any);
    }
  }));
}

TEST(Baselines, inTurnTheLowerIdChoosesFirst) {
  const CostTable table = table_of({{5.0, 6.0, 30.0}, {1.0, 9.0, 30.0}}, kThree);
  EXPECT_EQ(assign_in_turn(table), (Assignment{0, 1}));
}

TEST(Baselines, utilityFallsWhereAnotherTargetSees) {
  const CostTable table = table_of({{5.0, 6.0, 20.0}, {5.0, 6.0, 20.0}}, kThree);
  EXPECT_EQ(assign_by_utility(table, kOpen, 30.0), (Assignment{0, 2})) << "the one at 3 m is seen anyway";
  EXPECT_EQ(assign_by_utility(table, kWalled, 30.0), (Assignment{0, 1})) << "a wall between";
}

TEST(Baselines, utilityOfAGoalThatIsTakenIsNotForEverZero) {
  const CostTable table = table_of({{5.0}, {6.0}}, {{0.0, 0.0}});
  EXPECT_EQ(assign_by_utility(table, kOpen, 30.0), (Assignment{0, 0})) << "nothing better: both go";
}

TEST(Baselines, minPosSendsARobotWhereFewAreNearer) {
  // Both are nearest to the first goal; the second robot is first in rank at the last one.
  const CostTable table = table_of({{5.0, 8.0, 50.0}, {6.0, 9.0, 40.0}}, kThree);
  EXPECT_EQ(assign_min_pos(table), (Assignment{0, 2}));
}

TEST(Baselines, minPosIsTheDistanceForOneRobotAlone) {
  const CostTable table = table_of({{5.0, 4.0, 40.0}}, kThree);
  EXPECT_EQ(assign_min_pos(table), (Assignment{1}));
}

}  // namespace
}  // namespace topo::team

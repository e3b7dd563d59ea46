// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/shares.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace topo::team {
namespace {

using types::Vector2;
using Goals = std::vector<std::size_t>;

/// Goals along a corridor, and two robots in it.
class TwoInACorridor : public ::testing::Test {
 protected:
  [[nodiscard]] Goals share(std::size_t row) const {
    return share_of_goals({table_, claims_, between_}, row);
  }
  void stand(std::size_t row, double x_m) {
    for (std::size_t goal = 0; goal < table_.goals().size(); ++goal)
      table_.cost_m(row, goal) = std::abs(table_.goals()[goal].x() - x_m);
  }

  CostTable table_{{1, 2}, {Vector2(0.0, 0.0), Vector2(4.0, 0.0), Vector2(20.0, 0.0), Vector2(26.0, 0.0)}};
  Assignment claims_{std::nullopt, std::nullopt};
  std::function<double(std::size_t, std::size_t)> between_ = [this](std::size_t a, std::size_t b) {
    return std::abs(table_.goals()[a].x() - table_.goals()[b].x());
  };
};

TEST_F(TwoInACorridor, ANearerRobotHasAGoal) {
  stand(0, 2.0);
  stand(1, 22.0);
  EXPECT_EQ(share(0), (Goals{0, 1}));
  EXPECT_EQ(share(1), (Goals{2, 3}));
}

TEST_F(TwoInACorridor, OfEqualOnesTheLowerIdHasIt) {
  stand(0, 10.0);
  stand(1, 10.0);
  EXPECT_EQ(share(0), (Goals{0, 1, 2, 3}));
}

TEST_F(TwoInACorridor, WhereItIsGoingCountsAsWhereItIs) {
  stand(0, 10.0);
  stand(1, 10.0);
  claims_ = {0, 2};
  EXPECT_EQ(share(0), (Goals{0, 1}));
  EXPECT_EQ(share(1), (Goals{2, 3}));
}

TEST_F(TwoInACorridor, WhatLiesAtAClaimIsItsWithoutABid) {
  stand(0, 2.0);
  stand(1, 13.0);
  claims_ = {0, 2};
  table_.cost_m(1, 3) = HUGE_VAL;  // not seen yet
  EXPECT_EQ(share(0), (Goals{0, 1}));
  EXPECT_EQ(share(1), (Goals{2})) << "nor is it offered what it cannot reach";
  claims_[1].reset();
  EXPECT_EQ(share(0), (Goals{0, 1, 3}));
}

TEST_F(TwoInACorridor, WhoHasNoneHelpsWhereTheOtherComesLast) {
  stand(0, 2.0);
  stand(1, -5.0);
  claims_ = {0, std::nullopt};
  EXPECT_EQ(share(0), (Goals{0, 1, 2, 3}));
  EXPECT_EQ(share(1), Goals{3}) << "the other has three before";
  stand(1, -60.0);
  EXPECT_EQ(share(1), Goals{}) << "it would be later at each";
  between_ = [this](std::size_t a, std::size_t b) {  // doors onto the corridor, through rooms
    return 30.0 + std::abs(table_.goals()[a].x() - table_.goals()[b].x());
  };
  stand(0, 12.0);
  stand(1, 14.0);
  table_.cost_m(1, 2) = table_.cost_m(1, 3) = 18.0;
  claims_ = {0, std::nullopt};
  EXPECT_EQ(share(0), (Goals{0, 1, 2, 3}));
  EXPECT_EQ(share(1), Goals{3});
}

TEST_F(TwoInACorridor, AloneARobotHasAll) {
  CostTable alone({7}, table_.goals());
  for (std::size_t goal = 0; goal < 3; ++goal) alone.cost_m(0, goal) = 5.0;
  const Assignment claims(1);
  EXPECT_EQ(share_of_goals({alone, claims, between_}, 0), (Goals{0, 1, 2}));
}

}  // namespace
}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/plan.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace topo::pipeline {
namespace {

using types::Vector2;

TEST(PutPath, isInOdomAndSaysWhetherItIsTheWholeWay) {
  std::vector<Vector2> path;
  for (int i = 0; i < 10; ++i) path.emplace_back(0.1 * i, 0.0);
  const types::Transform2<types::Map, types::Odom> T_map_odom(1.0, 2.0, 1.5707963267948966);
  Plan plan;
  put_path(path, T_map_odom, plan);
  ASSERT_EQ(plan.points, 10);
  EXPECT_TRUE(plan.path_ends_at_goal);
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_LT((T_map_odom.se2() * plan.path_odom[i] - path[i]).norm(), 1e-9);
  path.resize(1000, Vector2(1.0, 0.0));
  put_path(path, T_map_odom, plan);
  EXPECT_EQ(plan.points, Plan::kMaxPoints);
  EXPECT_FALSE(plan.path_ends_at_goal);
  put_path({}, T_map_odom, plan);
  EXPECT_EQ(plan.points, 0);
}

}  // namespace
}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/explore/contender.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace topo::bench {
namespace {

pipeline::PlannerParams planner_of(const std::string& name) {
  pipeline::PlannerParams planner;
  const auto set = set_contender(name, planner);
  EXPECT_TRUE(set.has_value()) << (set ? "" : set.error().message);
  return planner;
}

TEST(Contender, hasEveryNameThatIsListed) {
  for (const std::string& name : contender_names()) {
    const bool topometric = name.starts_with("topometric");
    EXPECT_EQ(planner_of(name).explore.strategy == exploration::Strategy::kTopometric, topometric) << name;
  }
  EXPECT_EQ(contender_names().size(), 8U);
}

TEST(Contender, isWholeUnlessAPartIsTakenAway) {
  const pipeline::PlannerParams whole = planner_of("topometric");
  EXPECT_TRUE(whole.analysis.wall_store);
  EXPECT_TRUE(whole.explore.k_means);
  EXPECT_TRUE(std::isfinite(whole.analysis.places.width_ratio_max));
}

TEST(Contender, isWithoutOnePartAndNoOther) {
  const pipeline::PlannerParams no_walls = planner_of("topometric_no_walls");
  EXPECT_FALSE(no_walls.analysis.wall_store);
  EXPECT_TRUE(no_walls.explore.k_means);
  const pipeline::PlannerParams no_k_means = planner_of("topometric_no_kmeans");
  EXPECT_FALSE(no_k_means.explore.k_means);
  EXPECT_TRUE(no_k_means.analysis.wall_store);
  const pipeline::PlannerParams no_places = planner_of("topometric_no_places");
  EXPECT_TRUE(std::isinf(no_places.analysis.places.width_ratio_max));
  EXPECT_TRUE(no_places.explore.k_means);
  EXPECT_TRUE(no_places.analysis.wall_store);
}

TEST(Contender, thatNobodyKnowsIsRefusedWithTheNames) {
  pipeline::PlannerParams planner;
  const auto set = set_contender("topometric_no_luck", planner);
  ASSERT_FALSE(set.has_value());
  for (const std::string& name : contender_names())
    EXPECT_NE(set.error().message.find(name), std::string::npos) << set.error().message;
}

}  // namespace
}  // namespace topo::bench

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
  EXPECT_EQ(contender_names().size(), 12U);
}

TEST(Contender, isWholeUnlessAPartIsTakenAway) {
  const pipeline::PlannerParams whole = planner_of("topometric");
  EXPECT_TRUE(whole.analysis.wall_store);
  EXPECT_FALSE(whole.explore.rule.has_value());
  EXPECT_TRUE(std::isfinite(whole.analysis.places.width_ratio_max));
}

TEST(Contender, isWithoutOnePartAndNoOther) {
  const pipeline::PlannerParams no_walls = planner_of("topometric_no_walls");
  EXPECT_FALSE(no_walls.analysis.wall_store);
  EXPECT_FALSE(no_walls.explore.rule.has_value());
  const pipeline::PlannerParams no_k_means = planner_of("topometric_no_kmeans");
  EXPECT_EQ(no_k_means.explore.rule, team::Rule::kNoClusters);
  EXPECT_TRUE(no_k_means.analysis.wall_store);
  const pipeline::PlannerParams clusters = planner_of("topometric_kmeans");
  EXPECT_EQ(clusters.explore.rule, team::Rule::kClusters);
  EXPECT_TRUE(clusters.analysis.wall_store);
  const pipeline::PlannerParams in_turn = planner_of("topometric_gaps_in_turn");
  EXPECT_LT(in_turn.explore.tour.now_share, 0.0);
  EXPECT_FALSE(in_turn.explore.ending.stays_out);
  const pipeline::PlannerParams looks = planner_of("topometric_all_looks");
  EXPECT_LT(looks.explore.worth.look_m2ps, 1e-6);
  EXPECT_EQ(looks.explore.tour.now_share, exploration::TourParams{}.now_share);
  const pipeline::PlannerParams stays = planner_of("topometric_stays_out");
  EXPECT_TRUE(stays.explore.ending.stays_out);
  EXPECT_FALSE(stays.explore.rule.has_value());
  const pipeline::PlannerParams no_places = planner_of("topometric_no_places");
  EXPECT_TRUE(std::isinf(no_places.analysis.places.width_ratio_max));
  EXPECT_FALSE(no_places.explore.rule.has_value());
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

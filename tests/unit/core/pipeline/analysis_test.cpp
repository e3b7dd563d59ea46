// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/analysis.hpp"

#include <gtest/gtest.h>

#include "core/pipeline/prepared_map.hpp"
#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

const std::vector<std::string> kFurnished{
    "########################################", "#                   #                  #",
    "#                   #                  #", "#      ##           #        #         #",
    "#      ##           #                  #", "#                                      #",
    "#   S                                  #", "#                                      #",
    "#                   #                  #", "#          #        #     ##           #",
    "#                   #     ##           #", "#                   #                  #",
    "#                   #                  #", "########################################"};

TEST(Analysis, WhatItRemembersChangesNothingOnAGrowingMap) {
  ToyBuilding building(kFurnished, 4.0);
  PlanningState state({});
  AnalysisMemory memory;
  int furnished = 0;
  for (int i = 0; i < 12; ++i) {
    (void)building.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}});
    const grid::DenseMap map = prepare_map(building.snapshot(), {}, 0.3);
    const std::vector<float> clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    AnalysisMemory nothing;
    const Analysis fresh = analyse(building.snapshot(), map, clearance_m, {}, {}, nothing);
    const Analysis again = analyse(building.snapshot(), map, clearance_m, {}, {}, memory);
    ASSERT_EQ(again.places.labels, fresh.places.labels) << i;
    ASSERT_EQ(again.skeleton.on, fresh.skeleton.on) << i;
    ASSERT_EQ(again.goals.goals.size(), fresh.goals.goals.size()) << i;
    if (!nothing.without_furniture.clearance_m().empty()) ++furnished;
  }
  EXPECT_GE(furnished, 3) << "too little furniture to show anything";
}

}  // namespace
}  // namespace topo::pipeline

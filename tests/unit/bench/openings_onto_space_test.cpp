// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/goals/openings_onto_space.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

using grid::CellState;

constexpr double kCell_m = 0.1;
const types::Se2 kBuildingMap{3.0, -2.0, 0.0};  ///< where the map lies in the building

/// A hall of 10 x 3 m, all known, from the map's origin on, with a door of 1.2 m in its upper wall at x = 5
/// m.
analysis::Analysis hall() {
  analysis::Analysis a;
  a.map.resolution_m = kCell_m;
  a.map.box = {{-5, -5}, {105, 35}};
  a.map.cells.assign(static_cast<std::size_t>(a.map.width()) * static_cast<std::size_t>(a.map.height()),
                     CellState::kUnknown);
  for (int y = -1; y <= 30; ++y) {
    for (int x = -1; x <= 100; ++x) {
      const bool door = y == 30 && x >= 44 && x < 56;
      const bool wall = (y == -1 || y == 30 || x == -1 || x == 100) && !door;
      a.map.cells[a.map.index({x, y})] = wall ? CellState::kOccupied : CellState::kFree;
    }
  }
  return a;
}

/// The hall, and behind its door a room so wide and deep.
DrivableTruth building(double side_m) {
  constexpr double kRadius_m = 0.3;
  sim::Raster poses(0.05, {2.0, -3.0}, 300, 300);
  const auto fill = [&](double x0, double y0, double x1, double y1) {
    for (int y = 0; y < poses.height; ++y) {
      for (int x = 0; x < poses.width; ++x) {
        const types::Vector2 p = kBuildingMap.inverse() * poses.center(x, y);
        if (p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1) poses.set(x, y, 1);
      }
    }
  };
  fill(0.0 + kRadius_m, 0.0 + kRadius_m, 10.0 - kRadius_m, 3.0 - kRadius_m);
  fill(4.4 + kRadius_m, 2.0, 5.6 - kRadius_m, 4.0);
  fill(4.4 + kRadius_m, 3.0 + kRadius_m, 4.4 + side_m - kRadius_m, 3.0 + side_m - kRadius_m);
  return drivable_truth(std::move(poses), kRadius_m);
}

TEST(OpeningsOntoSpace, ADoorToALargeRoomIsOneAndToAClosetNone) {
  const OpeningsOntoSpace found = openings_onto_space(hall(), building(5.0), kBuildingMap);
  ASSERT_EQ(found.openings.size(), 1U);
  EXPECT_NEAR(found.openings[0].space_m2, 25.0, 2.0);
  EXPECT_NEAR(found.openings[0].width_m, 1.2, 0.11);
  EXPECT_NEAR((found.openings[0].p_map - types::Vector2(5.0, 3.05)).norm(), 0.0, 0.15);
  EXPECT_TRUE(openings_onto_space(hall(), building(2.0), kBuildingMap).openings.empty());
}

TEST(OpeningsOntoSpace, AGoalNearWhereARobotWouldStandIsForIt) {
  const auto has_goal = [](const types::Vector2& p_map) {
    analysis::Analysis a = hall();
    goals::Goal goal;
    goal.p_map = goal.opening = p_map;
    a.goals.goals.push_back(goal);
    const OpeningsOntoSpace found = openings_onto_space(a, building(5.0), kBuildingMap);
    EXPECT_EQ(found.goals, found.openings.at(0).has_goal ? 1U : 0U);
    return found.openings.at(0).has_goal;
  };
  EXPECT_TRUE(has_goal({5.0, 2.5}));
  EXPECT_TRUE(has_goal({3.0, 1.5}));
  EXPECT_FALSE(has_goal({1.0, 1.5})) << "too far from the door";
}

TEST(OpeningsOntoSpace, SayWhatBecameOfTheNearestCandidate) {
  analysis::Analysis a = hall();
  EXPECT_EQ(openings_onto_space(a, building(5.0), kBuildingMap).openings.at(0).why, "no candidate near");
  goals::Goal goal;
  goal.p_map = goal.opening = {5.0, 3.0};
  goal.verdict = goals::Verdict::kVisited;
  a.goals.rejected.push_back(goal);
  EXPECT_EQ(openings_onto_space(a, building(5.0), kBuildingMap).openings.at(0).why,
            goals::to_text(goals::Verdict::kVisited));
}

}  // namespace
}  // namespace topo::bench

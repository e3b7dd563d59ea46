// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "core/pipeline/planning_step.hpp"
#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

constexpr double kWall_m = 5.0;  ///< from the start

/// Two rooms, and between them a door of half a metre, in which no P3-DX can turn.
std::vector<std::string> two_rooms() {
  std::vector<std::string> rows(18, "#" + std::string(24, ' ') + "#" + std::string(24, ' ') + "#");
  rows.insert(rows.begin(), std::string(51, '#'));
  rows.push_back(std::string(51, '#'));
  rows[9][5] = 'S';
  rows[9][25] = rows[10][25] = ' ';
  return rows;
}

PlannerParams params_with(double tight_m) {
  PlannerParams params;
  params.travel.tight_m = tight_m;
  params.explore.final_sweep.promise_min = 1e9;
  return params;
}

struct PassageEnd {
  Activity activity = Activity::kThinking;
  double known = 0.0;
  int times_stuck = 0;
};

/// Of an exploration in which the robot, if `sticks`, gets stuck whenever it comes to the door.
PassageEnd explore(const PlannerParams& params, bool sticks) {
  ToyBuilding building(two_rooms());
  const types::Vector2 start = building.robot();
  const types::Vector2 door = start + types::Vector2(kWall_m, 0.0);
  PlanningState state(params);
  PassageEnd end;
  bool was_near = false;
  for (int i = 0; i < 900; ++i) {
    const double step_m = building.control().mode == ControlMode::kStuck ? 0.0 : 0.3;
    const PlanningOutput out = building.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}}, step_m);
    const bool is_near = (building.robot() - door).norm() < 0.8;
    building.control().mode = sticks && is_near && !was_near ? ControlMode::kStuck : ControlMode::kFollowing;
    if (building.control().mode == ControlMode::kStuck) ++end.times_stuck;
    was_near = is_near;
    end.activity = out.report->activity;
    if (out.report->mission_ended) break;
  }
  end.known = building.coverage();
  EXPECT_LT((building.robot() - start).norm(), 0.3);
  return end;
}

TEST(TightPassage, IsDrivenThroughWhenNothingElseIsLeft) {
  const PassageEnd through = explore(params_with(0.22), false);
  EXPECT_EQ(through.activity, Activity::kDone);
  EXPECT_GT(through.known, 0.99);
  EXPECT_LT(explore(params_with(0.297), false).known, 0.9) << "what is seen through the door";
}

TEST(TightPassage, InWhichTheRobotDidNotGetOnIsClosedForTheMission) {
  const PassageEnd end = explore(params_with(0.22), true);
  EXPECT_EQ(end.activity, Activity::kDone);
  EXPECT_LT(end.known, 0.97) << "what is seen from before the door";
  EXPECT_EQ(end.times_stuck, 1);
}

/// All around, a hundredth of a radian apart: three beams end beside one another at each point.
types::Scan scan_of(std::span<const types::Vector2> points_base, types::Stamp now) {
  constexpr double kStep_rad = 0.01;
  types::Scan scan;
  scan.first_beam = scan.arrival = now;
  scan.geometry.angle_min_rad = static_cast<float>(-std::numbers::pi);
  scan.geometry.angle_increment_rad = static_cast<float>(kStep_rad);
  scan.beams = 628;
  std::fill_n(scan.range_m.begin(), scan.beams, types::kNoReturn);
  for (const types::Vector2& p : points_base) {
    const auto beam =
        static_cast<std::size_t>(std::lround((std::atan2(p.y(), p.x()) + std::numbers::pi) / kStep_rad));
    for (std::size_t i = beam - 1; i <= beam + 1; ++i) scan.range_m[i] = static_cast<float>(p.norm());
  }
  return scan;
}

/// Does the route of a robot that came through the door lead home when its scanner has the jambs so far from
/// the middle of the door?
bool goes_back_past(double beside_m) {
  ToyBuilding building(two_rooms());
  PlanningState state(params_with(0.22));
  const types::Vector2 door = building.robot() + types::Vector2(kWall_m, -0.125);
  const Mission beyond{1, Order::kGoTo, false, door + types::Vector2(1.2, 0.0)};
  for (int i = 0; i < 60 && building.robot().x() < door.x() + 0.9; ++i) building.run_period(state, beyond);
  EXPECT_GT(building.robot().x(), door.x() + 0.8);
  building.run_period(state, beyond, 0.0);
  const types::Se2 T_map_base = building.control().odometry.T_odom_base.se2();
  const std::array jambs{T_map_base.inverse() * (door + types::Vector2(0.0, beside_m)),
                         T_map_base.inverse() * (door - types::Vector2(0.0, beside_m))};
  const types::Scan scan = scan_of(jambs, building.now());
  building.show(&scan);
  const PlanningOutput out = building.run_period(state, {2, Order::kHome, false, {0.0, 0.0}}, 0.0);
  return out.plan.moving && !out.report->route_map.empty() && out.report->route_map.back().x() < door.x();
}

TEST(TightPassage, IsNotShutByNoiseToWhoCameThrough) {
  EXPECT_TRUE(goes_back_past(0.30));
  EXPECT_TRUE(goes_back_past(0.21));
  EXPECT_FALSE(goes_back_past(0.08));
}

}  // namespace
}  // namespace topo::pipeline

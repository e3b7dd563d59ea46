// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/planning_step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

using ::testing::HasSubstr;

/// A corridor with a junction, a dead end, three rooms behind doors of 1 m.
const std::vector<std::string> kFloor = {
    "################################################################",
    "#                    #                    #                    #",
    "#                    #                    #                    #",
    "#                    #                    #                    #",
    "#                    #                    #                    #",
    "#                    #                    #                    #",
    "#                    #                    #                    #",
    "########    ####################    ##############    ##########",
    "#                                                              #",
    "#                                                              #",
    "#                                                              #",
    "#                                                              #",
    "#   S                                                          #",
    "#                                                              #",
    "#                                                              #",
    "########################        ################################",
    "                       #        #",
    "                       #        #",
    "                       #        #",
    "                       #        #",
    "                       #        #",
    "                       #        #",
    "                       #        #",
    "                       #        #",
    "                       #        #",
    "                       ##########",
};

PlannerParams params_of(exploration::Strategy strategy, Finish finish) {
  PlannerParams params;
  params.explore.strategy = strategy;
  params.explore.finish = finish;
  return params;
}

struct Outcome {
  PlanningOutput last;
  int periods = 0;
};

Outcome run_until_ended(ToyBuilding& building, PlanningState& state, const Mission& mission,
                        int periods_max) {
  Outcome run;
  do {
    run.last = building.run_period(state, mission);
    ++run.periods;
  } while (!run.last.report->mission_ended && run.periods < periods_max);
  return run;
}

const types::Vector2 kNowhere{0.0, 0.0};

class BothStrategies : public ::testing::TestWithParam<exploration::Strategy> {};

TEST_P(BothStrategies, exploreAllAndComeHome) {
  ToyBuilding building(kFloor);
  const types::Vector2 start = building.robot();
  PlanningState state(params_of(GetParam(), Finish::kComplete));
  const Outcome run = run_until_ended(building, state, {1, Order::kExplore, false, kNowhere}, 1200);
  EXPECT_EQ(run.last.report->activity, Activity::kDone) << run.last.report->reason;
  EXPECT_GE(building.coverage(), 0.97);
  EXPECT_LE((building.robot() - start).norm(), 0.3);
  EXPECT_FALSE(run.last.plan.moving);
}

INSTANTIATE_TEST_SUITE_P(Strategies, BothStrategies,
                         ::testing::Values(exploration::Strategy::kTopometric,
                                           exploration::Strategy::kNearestFrontier),
                         [](const auto& each) { return std::string(to_text(each.param)); });

TEST(PlanningStep, standsUntilItIsTold) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  for (int i = 0; i < 10; ++i) {
    const PlanningOutput out = building.run_period(state, {});
    EXPECT_FALSE(out.plan.moving);
    EXPECT_EQ(out.report->activity, Activity::kIdle);
  }
  EXPECT_EQ(building.path_m(), 0.0);
}

TEST(PlanningStep, whatHinderedIsTheReasonAsLongAsItHinders) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  EXPECT_EQ(planning_step(state, {}).report->reason, "no map yet");
  EXPECT_EQ(building.run_period(state, {}).report->reason, "no mission yet");
  building.control().estop_latched = true;
  EXPECT_THAT(building.run_period(state, {}).report->reason, HasSubstr("emergency stop"));
  building.control().estop_latched = false;
  EXPECT_EQ(building.run_period(state, {}).report->reason, "no mission yet");
}

TEST(PlanningStep, pausesAndGoesOn) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  Mission mission{1, Order::kExplore, false, kNowhere};
  for (int i = 0; i < 10; ++i) (void)building.run_period(state, mission);
  mission.paused = true;
  const double gone_m = building.path_m();
  EXPECT_GT(gone_m, 0.5);
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(building.run_period(state, mission).report->activity, Activity::kPaused);
  EXPECT_EQ(building.path_m(), gone_m);
  mission.paused = false;
  for (int i = 0; i < 10; ++i) (void)building.run_period(state, mission);
  EXPECT_GT(building.path_m(), gone_m + 0.5);
}

TEST(PlanningStep, aStuckGoalIsGivenUpWithItsReason) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const Mission mission{1, Order::kExplore, false, kNowhere};
  for (int i = 0; i < 4; ++i) (void)building.run_period(state, mission);
  building.control().mode = ControlMode::kStuck;
  const PlanningOutput out = building.run_period(state, mission);
  ASSERT_EQ(out.report->deferred.size(), 1U);
  EXPECT_THAT(out.report->deferred.front().why, HasSubstr("stuck"));
  EXPECT_GT(out.report->deferred.front().until, building.now());
}

/// A mission during which the battery gets low, some metres from the start.
Outcome run_with_low_battery(const Mission& mission) {
  ToyBuilding building(kFloor);
  const types::Vector2 start = building.robot();
  PlanningState state({});
  const Mission exploration{1, Order::kExplore, false, kNowhere};
  // No farther than it takes, so that the operator's goal is more than the battery's ten seconds away.
  const auto away_m = [&] { return (building.robot() - start).norm(); };
  for (int i = 0; i < 30 && away_m() <= 2.0; ++i) (void)building.run_period(state, exploration);
  EXPECT_GT(away_m(), 2.0);
  for (int i = 0; i < 2; ++i) (void)building.run_period(state, mission);
  building.control().battery_v = 11.2F;
  Outcome run = run_until_ended(building, state, mission, 200);
  EXPECT_TRUE(run.last.report->mission_ended);
  EXPECT_LE((building.robot() - start).norm(), 0.3);
  return run;
}

TEST(PlanningStep, withoutProgressTheGoalIsDeferred) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const Mission mission{1, Order::kExplore, false, kNowhere};
  for (int i = 0; i < 4; ++i) (void)building.run_period(state, mission);
  types::Vector2 ahead(0.0, 0.0);
  PlanningOutput out;
  for (int i = 0; i < 60 && (i == 0 || out.report->deferred.empty()); ++i) {
    out = building.run_period(state, mission, 0.0);  // it stands, whatever the plan
    const auto& T = building.control().odometry.T_odom_base.se2();
    ahead = T * types::Vector2(0.45, 0.0);
  }
  ASSERT_EQ(out.report->deferred.size(), 1U);
  EXPECT_THAT(out.report->deferred.front().why, HasSubstr("no progress"));
  out = building.run_period(state, mission, 0.0);
  ASSERT_TRUE(out.plan.moving);
  for (std::size_t i = 5; i < out.plan.points; ++i)
    EXPECT_GT((out.plan.path_odom[i] - ahead).norm(), 0.2) << "half a metre on it is well beside it";
}

TEST(PlanningStep, aLowBatteryMeansHomeWithTheExplorationUnfulfilled) {
  const Outcome run = run_with_low_battery({1, Order::kExplore, false, kNowhere});
  EXPECT_EQ(run.last.report->activity, Activity::kFailed);
  EXPECT_EQ(run.last.report->reason, "the battery is low: came home");
}

TEST(PlanningStep, aLowBatteryMeansHomeInsteadOfTheOperatorsGoal) {
  const Outcome run = run_with_low_battery({2, Order::kGoTo, false, {14.0, 3.0}});
  EXPECT_EQ(run.last.report->activity, Activity::kFailed);
  EXPECT_EQ(run.last.report->reason, "the battery is low: came home");
}

TEST(PlanningStep, homeAsOrderedIsDoneWhateverTheBattery) {
  const Outcome run = run_with_low_battery({2, Order::kHome, false, kNowhere});
  EXPECT_EQ(run.last.report->activity, Activity::kDone);
}

/// A robot on its way home gets stuck as soon as it is within `near_m` of its start.
Activity stuck_on_the_way_home(double near_m) {
  ToyBuilding building(kFloor);
  const types::Vector2 start = building.robot();
  PlanningState state({});
  const auto away_m = [&] { return (building.robot() - start).norm(); };
  for (int i = 0; i < 30 && away_m() <= 2.0; ++i)
    (void)building.run_period(state, {1, Order::kExplore, false, kNowhere});
  const Mission home{2, Order::kHome, false, kNowhere};
  for (int i = 0; i < 200 && away_m() > near_m; ++i) (void)building.run_period(state, home, 0.1);
  EXPECT_LE(away_m(), near_m);
  EXPECT_GT(away_m(), near_m - 0.15);
  building.control().mode = ControlMode::kStuck;
  return building.run_period(state, home, 0.0).report->activity;
}

TEST(PlanningStep, whoGetsStuckBesideItsStartIsHome) {
  EXPECT_EQ(stuck_on_the_way_home(0.44), Activity::kDone);
  EXPECT_EQ(stuck_on_the_way_home(0.8), Activity::kReturning);
}

TEST(PlanningStep, standsWhenAnythingIsMissing) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const Mission mission{1, Order::kExplore, false, kNowhere};
  for (int i = 0; i < 4; ++i) (void)building.run_period(state, mission);
  building.control().base_ready = false;
  EXPECT_FALSE(building.run_period(state, mission).plan.moving);
  building.control().base_ready = true;
  EXPECT_TRUE(building.run_period(state, mission).plan.moving);
  building.control().estop_latched = true;
  EXPECT_FALSE(building.run_period(state, mission).plan.moving);
  PlanningInput nothing;
  nothing.now = building.now();
  nothing.mission = mission;
  EXPECT_FALSE(planning_step(state, nothing).plan.moving);
}

TEST(PlanningStep, aPlanSaysWhetherThePlaceIsKnownInThisVeryPeriod) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const Mission mission{1, Order::kExplore, false, kNowhere};
  PlanningInput nothing;
  nothing.now = building.now();
  EXPECT_FALSE(planning_step(state, nothing).plan.located) << "before the first map";
  EXPECT_TRUE(building.run_period(state, {}).plan.located) << "standing, as told";
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(building.run_period(state, mission).plan.located);
  building.control().estop_latched = true;
  EXPECT_TRUE(building.run_period(state, mission).plan.located) << "it stands, and knows where";
  building.control().estop_latched = false;
  building.control().base_ready = false;
  EXPECT_FALSE(building.run_period(state, mission).plan.located);
  building.control().base_ready = true;
  EXPECT_TRUE(building.run_period(state, mission).plan.located);
  // The mapper says nothing any more.
  const TrackedPose old = building.tracked();
  PlanningInput input;
  input.map = &building.snapshot();
  input.tracked = &old;
  input.control = &building.control();
  input.mission = mission;
  for (const bool later : {false, true}) {
    input.now = old.stamp + std::chrono::milliseconds(later ? 1001 : 1000);
    building.control().stamp = input.now;
    EXPECT_EQ(planning_step(state, input).plan.located, !later);
  }
  input.tracked = nullptr;
  EXPECT_FALSE(planning_step(state, input).plan.located);
}

TEST(PlanningStep, standsWhileItIsLostAndGoesOnWhenAScanMatches) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const Mission mission{1, Order::kExplore, false, kNowhere};
  for (int i = 0; i < 4; ++i) (void)building.run_period(state, mission);
  building.tracked().matched = false;
  for (int i = 0; i < 4; ++i) {  // two seconds
    const PlanningOutput out = building.run_period(state, mission);
    EXPECT_TRUE(out.plan.moving && out.plan.located) << "a short loss stops nothing";
  }
  for (int i = 0; i < 200; ++i) {
    const PlanningOutput out = building.run_period(state, mission);
    EXPECT_FALSE(out.plan.moving || out.plan.located);
    EXPECT_THAT(out.report->reason, HasSubstr("lost:"));
    EXPECT_FALSE(out.report->mission_ended) << "it is nobody's fault that there is no progress";
  }
  building.tracked().matched = true;
  const PlanningOutput out = building.run_period(state, mission);
  EXPECT_TRUE(out.plan.moving && out.plan.located);
  EXPECT_EQ(out.report->activity, Activity::kExploring);
  // Matched now and then is good enough.
  for (int i = 0; i < 30; ++i) {
    building.tracked().matched = i % 4 == 3;
    EXPECT_TRUE(building.run_period(state, mission).plan.located) << i;
  }
}

/// One period of whoever has this map, these messages and this time.
PlanningOutput plan_at(types::Stamp now, PlanningState& state, const Mission& mission, const MapSnapshot& map,
                       TrackedPose tracked, ControlReport control) {
  control.stamp = control.odometry.stamp = tracked.stamp = now;
  tracked.revision = map.revision;
  PlanningInput input;
  input.now = now;
  input.map = &map;
  input.tracked = &tracked;
  input.control = &control;
  input.mission = mission;
  return planning_step(state, input);
}

TEST(PlanningStep, aDecisionHoldsWhileTheOdometryDriftsAndNotOnABentMap) {
  using MapOdom = types::Transform2<types::Map, types::Odom>;
  const types::Se2 change{0.3, -0.2, 0.1};
  for (const bool bent : {false, true}) {
    ToyBuilding building(kFloor);
    PlanningState state({});
    const Mission mission{1, Order::kExplore, false, kNowhere};
    PlanningOutput out;
    for (int i = 0; i < 4; ++i) out = building.run_period(state, mission);
    const std::uint64_t decisions = out.report->decisions_made;
    MapSnapshot map = building.snapshot();
    TrackedPose tracked = building.tracked();
    ControlReport control = building.control();
    if (bent) {
      for (types::KeyframePose& keyframe : map.keyframes)
        keyframe.T_map_base = types::Transform2<types::Map, types::Base>(change * keyframe.T_map_base.se2());
    } else {  // the robot is where it was; only the wheels tell it otherwise
      const types::Se2 wheels = change * control.odometry.T_odom_base.se2();
      control.odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(wheels);
      tracked.T_map_odom = MapOdom(tracked.T_map_odom.se2() * change.inverse());
    }
    const PlanningOutput next = plan_at(building.now(), state, mission, map, tracked, control);
    EXPECT_EQ(next.report->decisions_made, decisions + (bent ? 1 : 0));
  }
}

TEST(PlanningStep, aQuietDecisionHoldsUntilEnoughChanged) {
  using std::chrono::seconds;
  ToyBuilding building(kFloor);
  PlannerParams params;
  params.hold.quiet_decision_holds = seconds(8);
  PlanningState state(params);
  const Mission mission{1, Order::kExplore, false, kNowhere};
  PlanningOutput out;
  for (int i = 0; i < 8; ++i) out = building.run_period(state, mission);
  MapSnapshot map = building.snapshot();
  types::Stamp now = building.now();
  const auto decisions_within = [&](types::Duration span) {
    const std::uint64_t before = out.report->decisions_made;
    for (const types::Stamp end = now + span; now < end; now += std::chrono::milliseconds(500)) {
      ++map.revision;  // with each a keyframe that shows nothing new
      out = plan_at(now, state, mission, map, building.tracked(), building.control());
    }
    return out.report->decisions_made - before;
  };
  while (decisions_within(std::chrono::milliseconds(500)) == 0) {
  }
  EXPECT_EQ(decisions_within(seconds(7)), 0U);
  EXPECT_EQ(decisions_within(seconds(2)), 1U) << "once more, though nothing has changed";
  map.changed_cells += 101;  // 0.25 m2 of cells of 0.05 m
  EXPECT_EQ(decisions_within(seconds(3)), 1U);
  ASSERT_TRUE(out.report->goal);
  const grid::CellIndex goal = map.grid.cell_at(out.report->goal->p_map);
  int seen = 0;
  for (int y = goal.y - 20; y <= goal.y + 20; ++y) {
    for (int x = goal.x - 20; x <= goal.x + 20; ++x) {
      if (map.grid.state({x, y}) != grid::CellState::kUnknown) continue;
      map.grid.tile_to_change(x >> 5, y >> 5).cells[grid::Tile::index(x & 31, y & 31)].misses = 5;
      ++seen;
    }
  }
  ASSERT_GE(seen, 10) << "the goal is at a frontier";
  EXPECT_EQ(decisions_within(seconds(2)), 1U);
}

/// Least distance of the plan's way to a point.
double distance_to_plan_m(const Plan& plan, const types::Vector2& p) {
  double least_m = HUGE_VAL;
  for (std::size_t i = 0; i < plan.points; ++i) least_m = std::min(least_m, (plan.path_odom[i] - p).norm());
  return least_m;
}

TEST(PlanningStep, whatWasTouchedBetweenTwoLooksIsGoneRound) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const types::Vector2 start = building.robot(), post = start + types::Vector2(2.0, 0.0);
  const Mission mission{1, Order::kGoTo, false, start + types::Vector2(5.0, 0.0)};
  PlanningOutput out = building.run_period(state, mission);
  ASSERT_LT(distance_to_plan_m(out.plan, post), 0.1);
  building.control().touches = 1;  // pressed and released: nothing else tells of it
  building.control().touched_odom = post;
  out = building.run_period(state, mission);
  EXPECT_TRUE(out.plan.moving);
  EXPECT_GT(distance_to_plan_m(out.plan, post), 0.3);
  EXPECT_THAT(out.report->decisions.back().text, HasSubstr("touched"));
  for (int i = 0; i < 3; ++i) out = building.run_period(state, mission);
  EXPECT_GT(distance_to_plan_m(out.plan, post), 0.3) << "once is remembered";
  EXPECT_EQ(out.report->decisions.size(), 1U);
}

TEST(PlanningStep, goesWhereTheOperatorSays) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const types::Vector2 target = building.robot() + types::Vector2(4.0, 0.0);
  const Outcome run = run_until_ended(building, state, {1, Order::kGoTo, false, target}, 100);
  EXPECT_EQ(run.last.report->activity, Activity::kDone);
  EXPECT_LE((building.robot() - target).norm(), 0.3);
}

TEST(PlanningStep, refusesTargetsItCannotReach) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const PlanningOutput out = building.run_period(state, {});
  ASSERT_NE(out.report->analysis, nullptr);
  TargetGround ground{out.report->analysis, out.report->area, building.robot()};
  const auto check = [&](const types::Vector2& p) { return check_target(ground, PlannerParams{}, p); };
  EXPECT_TRUE(check(building.robot() + types::Vector2(2.0, 0.0)).has_value());
  EXPECT_THAT(check({100.0, 100.0}).error().message, HasSubstr("unknown"));
  EXPECT_THAT(check({0.22, building.robot().y()}).error().message, HasSubstr("stands"));
}

/// An area withdrawn a moment ago still stands in the map as a wall: that is no reason that an operator can
/// act on.
TEST(PlanningStep, saysThatTheMapIsNotAnalysedWithANewAreaYet) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const types::Vector2 at = building.robot() + types::Vector2(2.0, 0.0);
  types::AreaLimits drawn;
  drawn.keep_out = {
      {at + types::Vector2(-0.5, -0.5), at + types::Vector2(0.5, -0.5), at + types::Vector2(0.0, 0.5)}};
  building.limit(&drawn);
  const PlanningOutput before = building.run_period(state, {});
  ASSERT_EQ(before.report->area, drawn);
  const auto check = [&](const PlanningOutput& out) {
    return check_target({out.report->analysis, out.report->area, building.robot()}, PlannerParams{}, at);
  };
  ASSERT_EQ(check(before).error().code, types::Errc::kBusy);
  building.limit(nullptr);
  EXPECT_TRUE(check(building.run_period(state, {})).has_value());
}

TEST(PlanningStep, goesRoundAnAreaThatIsDrawnOverItsRoute) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  const types::Vector2 start = building.robot(), target = start + types::Vector2(6.5, 0.0);
  const Mission mission{1, Order::kGoTo, false, target};
  for (int i = 0; i < 6; ++i) (void)building.run_period(state, mission);
  const double x_m = building.robot().x() + 1.0, y_m = start.y();
  types::AreaLimits drawn;
  drawn.keep_out = {{{x_m, y_m - 0.4}, {x_m + 2.0, y_m - 0.4}, {x_m + 2.0, y_m + 0.4}, {x_m, y_m + 0.4}}};
  building.limit(&drawn);
  PlanningOutput out;
  int periods = 0;
  do {
    out = building.run_period(state, mission);
    ASSERT_TRUE(types::allows(drawn, building.robot())) << periods;
    for (const types::Vector2& p : out.report->route_map) ASSERT_TRUE(types::allows(drawn, p)) << periods;
  } while (!out.report->mission_ended && ++periods < 100);
  EXPECT_EQ(out.report->activity, Activity::kDone) << out.report->reason;
  EXPECT_LE((building.robot() - target).norm(), 0.3);
}

TEST(PlanningStep, goesAgainWhereAnAreaWasWithdrawn) {
  ToyBuilding building(kFloor);
  PlanningState state({});
  types::AreaLimits drawn;
  const types::Vector2 target = building.robot() + types::Vector2(5.0, 0.0);
  const double x_m = target.x() - 2.0;
  drawn.keep_out = {{{x_m, 0.0}, {x_m + 1.0, 0.0}, {x_m + 1.0, 20.0}, {x_m, 20.0}}};
  building.limit(&drawn);
  const PlanningOutput shut = building.run_period(state, {1, Order::kGoTo, false, target});
  EXPECT_FALSE(shut.plan.moving);
  drawn.keep_out.clear();
  const Outcome run = run_until_ended(building, state, {2, Order::kGoTo, false, target}, 100);
  EXPECT_EQ(run.last.report->activity, Activity::kDone) << run.last.report->reason;
}

TEST(PlanningStep, doesNotLeaveItsArea) {
  ToyBuilding building(kFloor);
  PlannerParams params = params_of(exploration::Strategy::kTopometric, Finish::kComplete);
  params.area.keep_in = types::Polygon{{0.0, 0.0}, {7.0, 0.0}, {7.0, 7.0}, {0.0, 7.0}};
  PlanningState state(params);
  const Mission mission{1, Order::kExplore, false, kNowhere};
  PlanningOutput out;
  for (int i = 0; i < 400 && !(i > 0 && out.report->mission_ended); ++i) {
    out = building.run_period(state, mission);
    ASSERT_TRUE(types::allows(params.area, building.robot()));
  }
  EXPECT_EQ(out.report->activity, Activity::kDone);
  EXPECT_GT(building.path_m(), 1.0);
}

}  // namespace
}  // namespace topo::pipeline

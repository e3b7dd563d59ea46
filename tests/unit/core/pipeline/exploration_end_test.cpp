// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// When an exploration ends, and when it goes on although nothing seemed to be left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/unit/core/pipeline/toy_building.hpp"

namespace topo::pipeline {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

/// A corridor, and a hall behind a door of 1.25 m that can be shut.
class Door : public ::testing::Test {
 protected:
  static std::vector<std::string> floor() {
    std::vector<std::string> rows(10, "#" + std::string(40, ' ') + "#" + std::string(40, ' ') + "#");
    rows.insert(rows.begin(), std::string(83, '#'));
    rows.push_back(std::string(83, '#'));
    rows[6][4] = 'S';
    for (const int row : kDoorRows) rows[static_cast<std::size_t>(row)][kDoorColumn] = ' ';
    return rows;
  }
  void shut() {
    for (const int row : kDoorRows) building.close(kDoorColumn, row);
  }
  void unlock() {
    for (const int row : kDoorRows) building.open(kDoorColumn, row);
  }
  const PlanningReport& period() {
    out = building.run_period(state, mission);
    return *out.report;
  }
  /// Until the robot is at the door and has seen some of the hall.
  void go_to_the_door() {
    for (int i = 0; i < 200 && building.robot().x() < kDoor_m - 2.0; ++i) period();
    ASSERT_FALSE(out.report->mission_ended);
    ASSERT_LT(building.robot().x(), kDoor_m - 1.0);
  }
  /// Shut before the robot that comes to it, and open for one that turns away: until the robot is on its way
  /// home and has taken the hall up again so many times, or the mission is over. How often it has.
  int tease(int times) {
    go_to_the_door();
    int taken_up = 0;
    for (int i = 0; i < 3000 && !out.report->mission_ended; ++i) {
      const Activity before = out.report->activity;
      const Activity now = period().activity;
      if (before == Activity::kReturning && now == Activity::kExploring) ++taken_up;
      if (taken_up == times && now == Activity::kReturning) break;
      if (now == Activity::kExploring && building.robot().x() > kDoor_m - 2.5) shut();
      if (now == Activity::kReturning && building.robot().x() < kDoor_m - 3.5) unlock();
    }
    return taken_up;
  }

  static constexpr int kDoorColumn = 41;
  static constexpr std::array kDoorRows{4, 5, 6, 7, 8};  // from above and from below
  static constexpr double kDoor_m = 0.25 * kDoorColumn;
  static constexpr int kPatience = 12;  // periods of half a second

  ToyBuilding building{floor(), 4.0};
  PlanningState state{PlannerParams{}};
  Mission mission{1, Order::kExplore, false, {0.0, 0.0}};
  PlanningOutput out;
};

/// Without a single essential goal; how much of the floor is known in the end.
double known_in_the_end(ToyBuilding& building, double overlooked_m2) {
  PlannerParams params;
  params.explore.finish = Finish::kEssential;
  params.analysis.goals.opening_min_m = 100.0;
  params.explore.tour.overlooked_m2 = overlooked_m2;
  PlanningState state(params);
  PlanningOutput out;
  do {
    out = building.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}});
  } while (!out.report->mission_ended && building.now() < types::stamp_from_seconds(600.0));
  EXPECT_EQ(out.report->activity, Activity::kDone) << out.report->reason;
  return building.coverage();
}

TEST_F(Door, overlookedGapsAreInspectedBeforeGoingHome) {
  EXPECT_GT(known_in_the_end(building, 10.0), 0.9);
  ToyBuilding other{floor(), 4.0};
  EXPECT_LT(known_in_the_end(other, 1e6), 0.4);
}

/// The share of a corridor that is known in the end to a robot at its blind end, 0.6 m before the wall.
double known_from_the_blind_end(Finish finish, exploration::Strategy strategy) {
  std::vector<std::string> rows(7, std::string(60, '#'));
  for (std::size_t y = 1; y < 6; ++y) rows[y].replace(1, 58, 58, ' ');
  rows[3][56] = 'S';
  ToyBuilding building(rows);
  building.see_within(0.75 * std::numbers::pi);
  PlannerParams params;
  params.explore.finish = finish;
  params.explore.strategy = strategy;
  PlanningState state(params);
  for (int i = 0; i < 1000; ++i)
    if (building.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}}).report->mission_ended) break;
  return building.coverage();
}

TEST(BlindEnd, ARobotWithItsBackToAllThereIsTurnsBeforeItEnds) {
  using exploration::Strategy;
  for (const Finish finish : {Finish::kComplete, Finish::kEssential, Finish::kWorth})
    EXPECT_GT(known_from_the_blind_end(finish, Strategy::kTopometric), 0.95);
  for (const Strategy strategy : {Strategy::kNearestFrontier, Strategy::kGreedyFrontier, Strategy::kMinPos})
    EXPECT_GT(known_from_the_blind_end(Finish::kComplete, strategy), 0.95);
}

/// A corridor with a room at either end. In it, just east of the robot, a person stands until the robot is in
/// the room in the west: the robot was as near to the space behind as it gets.
class Stander {
 public:
  Stander() {
    for (const int row : {14, 15})
      for (const int column : {47, 48}) building_.close(column, row);
  }
  /// Explores until the robot turns home, where it would see that they have left; how much is known then.
  double known_in_the_end(Finish finish, bool leaves) {
    PlannerParams params;
    params.explore.finish = finish;
    PlanningState state(params);
    for (int i = 0; i < 1000; ++i) {
      const auto report = building_.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}}).report;
      if (report->activity == Activity::kReturning) break;
      if (leaves && building_.robot().x() < 5.0) leave();
    }
    return building_.coverage();
  }

 private:
  static std::vector<std::string> floor() {
    std::vector<std::string> rows(28, std::string(80, '#'));
    for (std::size_t y = 2; y < 26; ++y) {
      rows[y].replace(2, 20, 20, ' ');
      rows[y].replace(58, 20, 20, ' ');
    }
    for (std::size_t y = 11; y < 15; ++y) rows[y].replace(22, 36, 36, ' ');
    rows[12][44] = 'S';
    return rows;
  }
  void leave() {
    for (const int row : {14, 15})
      for (const int column : {47, 48}) building_.open(column, row);
  }
  ToyBuilding building_{floor(), 4.0};
};

TEST(Stander, whoMayHaveGoneIsLookedAtAgainBeforeTheEnd) {
  for (const Finish finish : {Finish::kWorth, Finish::kComplete}) {
    EXPECT_GT(Stander().known_in_the_end(finish, true), 0.95);
    EXPECT_LT(Stander().known_in_the_end(finish, false), 0.7)
        << "who stays ends the exploration all the same";
  }
}

TEST_F(Door, shutForGoodEndsTheExplorationAfterAWhileOfPatience) {
  go_to_the_door();
  shut();
  int waited = 0;
  for (int i = 0; i < 200 && out.report->activity != Activity::kReturning; ++i) {
    if (period().activity != Activity::kThinking) continue;
    ++waited;
    EXPECT_FALSE(out.plan.moving);
    EXPECT_THAT(out.report->reason, AnyOf(HasSubstr("no way to the goals left"), HasSubstr("tried again")));
  }
  EXPECT_GE(waited, kPatience);
  EXPECT_LE(waited, 2 * kPatience + 4) << "and once more, when what was given up before was tried again";
  for (int i = 0; i < 200 && !out.report->mission_ended; ++i) period();
  EXPECT_EQ(out.report->activity, Activity::kDone);
  EXPECT_THAT(out.report->reason, HasSubstr("no goal is left in reach"));
  EXPECT_LT(building.coverage(), 0.9);
}

TEST_F(Door, shutForAMomentEndsNothing) {
  go_to_the_door();
  shut();
  for (int i = 0; i < kPatience - 2; ++i) EXPECT_NE(period().activity, Activity::kReturning);
  unlock();
  bool returned_before_all = false;
  for (int i = 0; i < 400 && !out.report->mission_ended; ++i) {
    period();
    returned_before_all =
        returned_before_all || (out.report->activity == Activity::kReturning && building.coverage() < 0.9);
  }
  EXPECT_FALSE(returned_before_all);
  EXPECT_EQ(out.report->activity, Activity::kDone);
  EXPECT_GE(building.coverage(), 0.97);
}

TEST_F(Door, openingOnTheWayHomeIsTakenUpAgain) {
  go_to_the_door();
  shut();
  for (int i = 0; i < 200 && out.report->activity != Activity::kReturning; ++i) period();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(period().activity, Activity::kReturning);
  unlock();
  for (int i = 0; i < 3 && out.report->activity == Activity::kReturning; ++i) period();
  EXPECT_EQ(out.report->activity, Activity::kExploring);
  for (int i = 0; i < 400 && !out.report->mission_ended; ++i) period();
  EXPECT_EQ(out.report->activity, Activity::kDone);
  EXPECT_GE(building.coverage(), 0.97);
}

TEST_F(Door, thatTeasesAndNeverTiresDoesNotKeepTheRobotOut) {
  const int taken_up = tease(1000);
  EXPECT_TRUE(out.report->mission_ended);
  EXPECT_GE(taken_up, 2);
  EXPECT_LE(taken_up, 8);
}

/// The door on the right is the nearer one, and shut as long as the robot wants to go there.
TEST(TwoDoors, ofWhichOneIsShutWheneverTheRobotTurnsToItDoNotKeepItTurning) {
  std::vector<std::string> rows(
      10, "#" + std::string(24, ' ') + "#" + std::string(24, ' ') + "#" + std::string(24, ' ') + "#");
  constexpr std::size_t kLeft = 25, kRight = 50;
  for (const std::size_t row : {3U, 4U, 5U, 6U, 7U}) rows[row][kLeft] = rows[row][kRight] = ' ';
  rows[5][40] = 'S';
  rows.insert(rows.begin(), std::string(76, '#'));
  rows.push_back(std::string(76, '#'));
  ToyBuilding building{rows, 4.5};
  PlanningState state{PlannerParams{}};
  PlanningOutput out;
  const double right_m = 0.25 * kRight, left_m = 0.25 * kLeft;
  int periods = 0;
  for (; periods < 400 && building.robot().x() > left_m - 1.0; ++periods) {
    out = building.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}});
    ASSERT_FALSE(out.report->mission_ended) << out.report->reason;
    const bool wants_right = out.report->goal && out.report->goal->p_map.x() > right_m - 1.5;
    for (const int row : {4, 5, 6, 7, 8})
      wants_right ? building.close(kRight, row) : building.open(kRight, row);
  }
  EXPECT_LT(building.robot().x(), left_m) << "it went through the other one";
  EXPECT_LT(periods, 150);
  EXPECT_LT(out.report->goals_issued, 15U);
}

/// A goal without a route keeps nobody from the look.
TEST_F(Door, APlaceIsLookedAtAgainThoughTheWayToAGoalIsShut) {
  go_to_the_door();
  shut();
  building.doubt({{2.0, 1.5}});
  bool looks = false;
  for (int i = 0; i < 1000 && !out.report->mission_ended; ++i) {
    const bool looks_now = std::ranges::any_of(period().decisions, [](const Decision& d) {
      return d.text.find("taken: a place that is looked at again") != std::string::npos;
    });
    looks = looks || looks_now;
  }
  EXPECT_TRUE(out.report->mission_ended);
  EXPECT_TRUE(looks);
}

/// A map of one hall that is doubted at two places beside each other, and at one that no robot can reach.
class DoubtedHall : public ::testing::Test {
 protected:
  static std::vector<std::string> hall() {
    std::vector<std::string> rows(12, "#" + std::string(60, ' ') + "#");
    rows.insert(rows.begin(), std::string(62, '#'));
    rows.push_back(std::string(62, '#'));
    rows[6][4] = 'S';
    return rows;
  }
  /// How near the robot came to a place before it was done.
  double nearest_m(Finish finish) {
    PlannerParams params;
    params.explore.finish = finish;
    PlanningState state(params);
    double nearest = HUGE_VAL;
    for (int i = 0; i < 1000; ++i) {
      const PlanningOutput out = building.run_period(state, {1, Order::kExplore, false, {0.0, 0.0}});
      nearest = std::min(nearest, (building.robot() - place).norm());
      looks = std::ranges::count_if(out.report->decisions, [](const Decision& d) {
        return d.text.find("taken: a place that is looked at again") != std::string::npos;
      });
      if (out.report->mission_ended) return nearest;
    }
    ADD_FAILURE() << "not done";
    return nearest;
  }
  ToyBuilding building{hall(), 40.0};  // all is seen from the start
  const types::Vector2 place{12.0, 1.5}, beside{12.5, 1.5}, outside{30.0, 30.0};
  std::ptrdiff_t looks = 0;
};
class Doubted : public DoubtedHall, public ::testing::WithParamInterface<Finish> {};

TEST_P(Doubted, APlaceWhereTheMapIsDoubtedIsLookedAtOnceBeforeTheEnd) {
  building.doubt({place, beside, outside});
  EXPECT_LT(nearest_m(GetParam()), 1.0);
  EXPECT_EQ(looks, 1);
}
TEST_P(Doubted, AMapThatIsNotDoubtedIsNot) {
  (void)nearest_m(GetParam());
  EXPECT_EQ(looks, 0);
}
INSTANTIATE_TEST_SUITE_P(Finishes, Doubted,
                         ::testing::Values(Finish::kComplete, Finish::kEssential, Finish::kWorth));

}  // namespace
}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/mission_control.hpp"

#include <gmock/gmock.h>

namespace topo::daemon {
namespace {

using pipeline::Activity;
using pipeline::Order;
using ::testing::HasSubstr;

const types::Stamp kNow = types::stamp_from_seconds(100.0);

types::Stamp later(double seconds) { return kNow + types::from_seconds(seconds); }

pipeline::PlanningReport ending(std::uint64_t mission, Activity activity) {
  pipeline::PlanningReport report;
  report.mission = mission;
  report.activity = activity;
  report.mission_ended = true;
  report.reason = "because";
  return report;
}

class MissionControlTest : public ::testing::Test {
 protected:
  types::Status explore() { return missions.begin(Order::kExplore, {0.0, 0.0}, "", kNow); }
  MissionControl missions;
};

TEST_F(MissionControlTest, StandsUntilTold) {
  EXPECT_EQ(missions.mission().order, Order::kStand);
  EXPECT_EQ(missions.state(), MissionState::kNone);
  EXPECT_FALSE(missions.active());
  EXPECT_FALSE(missions.pause("x"));
  EXPECT_FALSE(missions.resume(""));
  EXPECT_FALSE(missions.stop(kNow));
  EXPECT_FALSE(missions.note(ending(0, Activity::kDone), kNow));
  EXPECT_EQ(missions.elapsed(later(5)), types::Duration::zero());
}

TEST_F(MissionControlTest, RefusedWithTheObstacleAsReason) {
  const auto refused = missions.begin(Order::kExplore, {0.0, 0.0}, "the base is away", kNow);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "the base is away");
  EXPECT_EQ(missions.mission().order, Order::kStand);
  ASSERT_TRUE(explore());
  ASSERT_TRUE(missions.pause("x"));
  EXPECT_FALSE(missions.resume("the e-stop is latched"));
  EXPECT_TRUE(missions.mission().paused);
}

TEST_F(MissionControlTest, PausedKeepsTheMission) {
  ASSERT_TRUE(explore());
  const auto number = missions.mission().number;
  ASSERT_TRUE(missions.pause("the e-stop"));
  EXPECT_TRUE(missions.mission().paused);
  EXPECT_EQ(missions.reason(), "the e-stop");
  ASSERT_TRUE(missions.resume(""));
  EXPECT_FALSE(missions.mission().paused);
  EXPECT_EQ(missions.mission().number, number);
  EXPECT_EQ(missions.mission().order, Order::kExplore);
}

TEST_F(MissionControlTest, OneExplorationAtATimeAndOthersReplaceIt) {
  ASSERT_TRUE(explore());
  const auto number = missions.number();
  const auto again = explore();
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("under way already"));
  ASSERT_TRUE(missions.begin(Order::kGoTo, {1.0, 2.0}, "", kNow));
  EXPECT_EQ(missions.mission().target, (types::Vector2{1.0, 2.0}));
  EXPECT_GT(missions.number(), number);
  ASSERT_TRUE(missions.begin(Order::kHome, {0.0, 0.0}, "", kNow));
  ASSERT_TRUE(explore());
}

TEST_F(MissionControlTest, EndsByPlanningsWordOnThisMissionOnly) {
  ASSERT_TRUE(explore());
  EXPECT_FALSE(missions.note(ending(missions.number() + 1, Activity::kDone), kNow));
  pipeline::PlanningReport running = ending(missions.number(), Activity::kExploring);
  running.mission_ended = false;
  EXPECT_FALSE(missions.note(running, kNow));
  EXPECT_TRUE(missions.note(ending(missions.number(), Activity::kDone), later(60)));
  EXPECT_EQ(missions.state(), MissionState::kDone);
  EXPECT_EQ(missions.reason(), "because");
  EXPECT_FALSE(missions.note(ending(missions.number(), Activity::kDone), later(61))) << "told twice";
  EXPECT_EQ(missions.elapsed(later(100)), types::from_seconds(60));
  EXPECT_TRUE(explore());
}

TEST_F(MissionControlTest, FailureAndStopAreNoSuccess) {
  ASSERT_TRUE(explore());
  EXPECT_TRUE(missions.note(ending(missions.number(), Activity::kFailed), kNow));
  EXPECT_EQ(missions.state(), MissionState::kFailed);
  ASSERT_TRUE(explore());
  const auto number = missions.mission().number;
  EXPECT_TRUE(missions.stop(kNow));
  EXPECT_EQ(missions.state(), MissionState::kStopped);
  EXPECT_EQ(missions.order(), Order::kExplore);
  EXPECT_EQ(missions.mission().order, Order::kStand);
  EXPECT_GT(missions.mission().number, number) << "planning takes it for a new one";
  EXPECT_EQ(missions.number(), number);
}

TEST_F(MissionControlTest, AVoidMapEndsTheMissionAsFailed) {
  EXPECT_FALSE(missions.fail("dropped", kNow)) << "there is none";
  ASSERT_TRUE(explore());
  const auto number = missions.mission().number;
  EXPECT_TRUE(missions.fail("the robot's place was dropped", kNow));
  EXPECT_EQ(missions.state(), MissionState::kFailed);
  EXPECT_EQ(missions.reason(), "the robot's place was dropped");
  EXPECT_EQ(missions.mission().order, Order::kStand);
  EXPECT_GT(missions.mission().number, number) << "planning takes it for a new one";
  EXPECT_FALSE(missions.resume(""));
}

}  // namespace
}  // namespace topo::daemon

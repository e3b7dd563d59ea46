// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/scene.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace topo::daemon {
namespace {

Json pose(double x_m, double theta_rad) { return {{"x_m", x_m}, {"y_m", 1.0}, {"theta_rad", theta_rad}}; }

Story sample() {
  Story story;
  story.states = {
      {1.0,
       {{"state", "driving"},
        {"kind", "state"},
        {"pose", pose(0.0, 3.0)},
        {"known_m2", 10.0},
        {"doubts", {"slip"}},
        {"goal", {{"x_m", 4.0}, {"y_m", 0.0}}},
        {"map", {{"keyframes", 1}}},
        {"team", {{{"robot", 2}, {"alive", true}, {"heard_s_ago", 0.3}}}}}},
      {2.0,
       {{"state", "driving"}, {"pose", pose(1.0, -3.0)}, {"known_m2", 12.0}, {"map", {{"keyframes", 3}}}}},
      {9.0,
       {{"state", "standing"}, {"pose", pose(5.0, 0.0)}, {"known_m2", 20.0}, {"map", {{"keyframes", 8}}}}}};
  story.events = {{0.5, {{"event", "decision"}, {"text", "near"}, {"kind", "event"}}},
                  {1.5, {{"event", "area"}, {"what", "drawn"}, {"areas", {{{"id", "1"}}}}}},
                  {3.0, {{"event", "decision"}, {"text", "far"}}},
                  {8.0, {{"event", "area"}, {"what", "withdrawn"}, {"areas", Json::array()}}}};
  return story;
}

TEST(Scene, BetweenTwoStatesTheRobotIsOnItsWay) {
  const Json status = status_at(sample(), 1.5, "robot-1");
  EXPECT_EQ(status["robot"], "robot-1");
  EXPECT_DOUBLE_EQ(status["pose"]["x_m"].get<double>(), 0.5);
  EXPECT_NEAR(std::abs(status["pose"]["theta_rad"].get<double>()), 3.14159, 0.001) << "the short way round";
  EXPECT_EQ(status["plausibility"]["doubts"][0]["found"], "slip");
  EXPECT_FALSE(status.contains("kind"));
}

TEST(Scene, AcrossAGapItStaysWhereItWas) {
  EXPECT_EQ(status_at(sample(), 5.0, "r")["pose"]["x_m"], 1.0);
  EXPECT_EQ(keyframes_at(sample(), 5.0), 3U);
}

TEST(Scene, BeforeTheFirstStateNothingIsSaid) {
  EXPECT_EQ(status_at(sample(), 0.2, "r"), (Json{{"state", "not begun yet"}, {"robot", "r"}}));
  EXPECT_EQ(keyframes_at(sample(), 0.2), 0U);
  EXPECT_TRUE(goals_at(Story{}, 0.0)["goal"].is_null());
}

TEST(Scene, AGoalHasTheDecisionForIt) {
  EXPECT_EQ(goals_at(sample(), 1.5)["decisions"][0]["text"], "near");
  EXPECT_EQ(goals_at(sample(), 1.5)["goal"]["x_m"], 4.0);
  EXPECT_EQ(goals_at(sample(), 3.0)["decisions"][0]["text"], "far");
}

TEST(Scene, AreasAreThoseOfTheLastWordOnThem) {
  EXPECT_TRUE(areas_at(sample(), 1.0)["areas"].empty());
  EXPECT_EQ(areas_at(sample(), 1.5)["areas"].size(), 1U);
  EXPECT_TRUE(areas_at(sample(), 8.0)["areas"].empty());
}

TEST(Scene, ThePastEndsAtThePosition) {
  const Json past = past_at(sample(), 3.0);
  ASSERT_EQ(past["events"].size(), 3U);
  EXPECT_EQ(past["events"][2]["text"], "far");
  EXPECT_EQ(past["known_m2"], Json::parse("[[1.0, 10.0], [2.0, 12.0]]"));
}

TEST(Scene, AHostileLogIsShownWithoutHarm) {
  Story story;
  for (const Json& odd : {Json(3), Json("x"), Json::array({1}), Json(nullptr)}) {
    story.states.push_back(
        {1.0,
         {{"pose", odd}, {"team", odd}, {"map", odd}, {"doubts", odd}, {"goal", odd}, {"known_m2", odd}}});
    story.events.push_back({1.0, {{"event", odd}, {"areas", odd}}});
  }
  for (const double t_s : {0.0, 1.0, 2.0}) {
    EXPECT_TRUE(status_at(story, t_s, "r").is_object());
    EXPECT_TRUE(goals_at(story, t_s).is_object());
    EXPECT_TRUE(areas_at(story, t_s).is_object());
    EXPECT_TRUE(past_at(story, t_s).is_object());
    EXPECT_EQ(keyframes_at(story, t_s), 0U);
  }
}

RC_GTEST_PROP(Scene, ThePastNeverGrowsSmaller, ()) {
  const double early = *rc::gen::inRange(0, 100) * 0.1, late = early + *rc::gen::inRange(0, 50) * 0.1;
  const Json before = past_at(sample(), early), after = past_at(sample(), late);
  RC_ASSERT(before["events"].size() <= after["events"].size());
  for (std::size_t i = 0; i < before["events"].size(); ++i)
    RC_ASSERT(before["events"][i] == after["events"][i]);
}

}  // namespace
}  // namespace topo::daemon

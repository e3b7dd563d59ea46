// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/team_scene.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>

namespace topo::daemon {
namespace {

Json mate_at(int robot, double heard_s_ago, double x_m) {
  return {{"robot", robot},
          {"alive", true},
          {"heard_s_ago", heard_s_ago},
          {"here", {{"pose", pose_json({x_m, 1.0, 0.0})}, {"claim", {{"x_m", 7.0}, {"y_m", 1.0}}}}}};
}

StoryLine state_with(double t_s, std::size_t keyframes, const Json& team) {
  return {t_s, {{"state", "driving"}, {"map", {{"keyframes", keyframes}}}, {"team", team}}};
}

double heard_s_ago(const Story& story, double t_s) {
  return team_at(story, t_s)["peers"][0]["heard_s_ago"].get<double>();
}

TEST(TeamScene, AMatesAgeGrowsWithTheTime) {
  Story story;
  story.states = {state_with(1.0, 1, Json::array({mate_at(2, 0.3, 0.0)})), {2.0, {{"state", "driving"}}}};
  EXPECT_DOUBLE_EQ(heard_s_ago(story, 1.5), 0.8);
  EXPECT_FALSE(team_at(story, 2.0)["present"]);
  EXPECT_EQ(team_at(story, 0.2), (Json{{"present", false}})) << "before the first state";
}

TEST(TeamScene, AMateThatIsHeardIsOnItsWayAndDoesNotAge) {
  Story story;
  story.states = {state_with(1.0, 1, Json::array({mate_at(2, 0.3, 0.0)})),
                  state_with(2.0, 1, Json::array({mate_at(2, 0.1, 1.0)}))};
  const Json team = team_at(story, 1.75);
  EXPECT_TRUE(team["present"]);
  EXPECT_DOUBLE_EQ(team["peers"][0]["heard_s_ago"].get<double>(), 0.15);
  EXPECT_DOUBLE_EQ(team["peers"][0]["here"]["pose"]["x_m"].get<double>(), 0.75);
  EXPECT_EQ(team["peers"][0]["here"]["claim"]["x_m"], 7.0);
}

RC_GTEST_PROP(TeamScene, ASilentMateAgesAsTimeGoesBy, ()) {
  const double before_s = *rc::gen::inRange(0, 100) * 0.1, share = *rc::gen::inRange(0, 100) * 0.01;
  Story story;
  story.states = {state_with(1.0, 1, Json::array({mate_at(2, before_s, 0.0)})),
                  state_with(2.0, 1, Json::array({mate_at(2, before_s + 1.0, 0.0)}))};
  RC_ASSERT(std::abs(heard_s_ago(story, 1.0 + share) - (before_s + share)) < 1e-9);
}

TEST(TeamScene, AcrossAGapAMateStaysAndAges) {
  Story story;
  story.states = {state_with(1.0, 1, Json::array({mate_at(2, 0.3, 0.0)})),
                  state_with(9.0, 1, Json::array({mate_at(2, 0.1, 8.0)}))};
  EXPECT_DOUBLE_EQ(heard_s_ago(story, 5.0), 4.3);
  EXPECT_EQ(team_at(story, 5.0)["peers"][0]["here"]["pose"]["x_m"], 0.0);
}

TEST(TeamScene, RunsOfOneRobotAreNotMixed) {
  Story story;
  story.states = {state_with(1.0, 1, Json::array({mate_at(2, 5.0, 0.0), mate_at(2, 0.1, 3.0)})),
                  state_with(2.0, 1, Json::array({mate_at(2, 6.0, 0.0), mate_at(2, 0.1, 4.0)}))};
  const Json peers = team_at(story, 1.5)["peers"];
  EXPECT_EQ(peers[0]["here"]["pose"]["x_m"], 0.0);
  EXPECT_EQ(peers[1]["here"]["pose"]["x_m"], 3.0);
}

TEST(TeamScene, ATeamOfWhichNobodyIsHeardIsOne) {
  Story story;
  story.states = {{1.0, {{"in_team", {{"robot", 1}, {"trouble", "no link"}}}}}};
  EXPECT_EQ(team_at(story, 1.0),
            (Json{{"present", true}, {"peers", Json::array()}, {"robot", 1}, {"trouble", "no link"}}));
}

TEST(TeamScene, WithoutAWordOnItsPlaceAMateIsWhereItsNewestKeyframeIs) {
  Story story;
  story.states = {state_with(1.0, 1, Json::array()),
                  state_with(2.0, 4, Json::array({Json{{"robot", 3}, {"alive", true}}}))};
  const std::array places{LastPlace{2, {5.0, 1.0, 0.0}, 1}, LastPlace{3, {6.0, 1.0, 0.0}, 3}};
  const Json peers = with_last_places(team_at(story, 2.5), story, 2.5, places)["peers"];
  ASSERT_EQ(peers.size(), 2U);
  EXPECT_EQ(peers[0]["robot"], 3);
  EXPECT_TRUE(peers[0]["alive"]);
  EXPECT_FALSE(peers[0].contains("by_map"));
  EXPECT_DOUBLE_EQ(peers[0]["here"]["age_s"].get<double>(), 0.5) << "its place is older than its word";
  EXPECT_EQ(peers[1]["robot"], 2);
  EXPECT_TRUE(peers[1]["by_map"]);
  EXPECT_EQ(peers[1]["here"]["pose"]["x_m"], 5.0);
}

TEST(TeamScene, AWordOnAMatesPlaceIsNewerThanItsKeyframes) {
  Story story;
  story.states = {state_with(1.0, 4, Json::array({mate_at(2, 0.3, 9.0)}))};
  const std::array places{LastPlace{2, {5.0, 1.0, 0.0}, 1}};
  const Json team = team_at(story, 1.0);
  EXPECT_EQ(with_last_places(team, story, 1.0, places), team);
}

TEST(TeamScene, AHostileLogIsShownWithoutHarm) {
  Story story;
  const std::array odd{Json(3), Json("x"), Json::array({1}), Json(nullptr),
                       Json{{"robot", {1}}, {"here", 1}}};
  for (const Json& one : odd) story.states.push_back(state_with(1.0, 1, one));
  for (const Json& one : odd) story.states.push_back(state_with(2.0, 1, Json::array({one, one})));
  for (const Json& one : odd) story.states.push_back({2.0, {{"in_team", one}, {"map", one}}});
  const std::array places{LastPlace{2, {}, 1}};
  for (const double t_s : {0.0, 1.0, 1.5, 2.0, 3.0}) {
    const Json team = team_at(story, t_s);
    EXPECT_TRUE(team.is_object());
    EXPECT_TRUE(with_last_places(team, story, t_s, places)["present"]);
  }
}

}  // namespace
}  // namespace topo::daemon

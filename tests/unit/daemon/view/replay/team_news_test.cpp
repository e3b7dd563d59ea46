// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/team_news.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;

Json mate_that(bool alive, bool joined, const char* duty, double goal_x_m) {
  return {{"robot", 2},
          {"alive", alive},
          {"map_joined", joined},
          {"status", {{"duty", duty}}},
          {"here", {{"claim", {{"x_m", goal_x_m}, {"y_m", 1.0}}}}}};
}

StoryLine state_of(double t_s, const Json& of_mate) { return {t_s, {{"team", Json::array({of_mate})}}}; }

std::vector<std::string> words_of(const std::vector<StoryLine>& news) {
  std::vector<std::string> words;
  for (const StoryLine& line : news) words.push_back(line.json["what"].get<std::string>());
  return words;
}

TEST(TeamNews, AreWhatChangesFromStateToState) {
  const auto news = team_news(
      {state_of(1.0, mate_that(true, false, "able", 4.0)), state_of(2.0, mate_that(true, true, "able", 4.0)),
       state_of(3.0, mate_that(true, true, "able", 5.0)), state_of(4.0, mate_that(true, true, "unable", 9.0)),
       state_of(5.0, mate_that(false, true, "over", 20.0))});
  EXPECT_THAT(words_of(news),
              ElementsAre("in reach", "is able to explore", "goes for", "its map and this robot's are one",
                          "is not able to explore", "goes for", "out of reach"));
  EXPECT_EQ(news[2].json["x_m"], 4.0);
  EXPECT_EQ(news[3].t_s, 2.0);
  EXPECT_EQ(news[5].json["x_m"], 9.0) << "a goal that moves by a metre is the same goal";
  EXPECT_EQ(news[5].json["robot"], 2);
  EXPECT_EQ(news[5].json["event"], "mate");
}

TEST(TeamNews, AnOrderIsToldWithEachNewAnswer) {
  const auto order = [](Json acknowledged, Json refused) {
    return Json{{"number", 4}, {"acknowledged", std::move(acknowledged)}, {"refused", std::move(refused)}};
  };
  const auto told = [](double t_s, const Json& of) { return StoryLine{t_s, {{"in_team", {{"order", of}}}}}; };
  const Json refused = Json::array({Json{{"robot", 3}, {"why", "latched"}}});
  const auto news = team_news(
      {told(1.0, order(Json::array(), Json::array())), told(2.0, order(Json::array({2}), Json::array())),
       told(3.0, order(Json::array({2}), Json::array())), told(4.0, order(Json::array({2}), refused))});
  ASSERT_EQ(news.size(), 2U);
  EXPECT_EQ(news[0].t_s, 2.0);
  EXPECT_EQ(news[0].json, (Json{{"event", "team_word"},
                                {"order", 4},
                                {"acknowledged", Json::array({2})},
                                {"refused", Json::array()}}));
  EXPECT_EQ(news[1].json["refused"], refused);
}

RC_GTEST_PROP(TeamNews, AStateThatIsSaidAgainIsNoNews, ()) {
  std::vector<StoryLine> once, twice;
  const int states = *rc::gen::inRange(1, 10);
  for (int i = 0; i < states; ++i) {
    const StoryLine line = state_of(i, mate_that(*rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>(),
                                                 "able", *rc::gen::inRange(0, 9)));
    once.push_back(line);
    twice.insert(twice.end(), {line, line});
  }
  RC_ASSERT(words_of(team_news(once)) == words_of(team_news(twice)));
}

TEST(TeamNews, StandAmongTheEventsInOrderOfTime) {
  Story story;
  story.states = {state_of(1.0, mate_that(true, false, "", 0.0))};
  story.events = {{0.5, {{"event", "ready"}}}, {2.0, {{"event", "done"}}}};
  story = with_team_news(std::move(story));
  ASSERT_EQ(story.events.size(), 4U);
  EXPECT_EQ(story.events[1].json["what"], "in reach");
  EXPECT_EQ(story.events[3].json["event"], "done");
}

TEST(TeamNews, AHostileLogIsReadWithoutHarm) {
  std::vector<StoryLine> states;
  for (const Json& odd : {Json(3), Json("x"), Json::array({1}), Json(nullptr), Json::object()}) {
    states.push_back({1.0, {{"team", odd}, {"in_team", odd}}});
    states.push_back({1.0, {{"team", Json::array({odd})}, {"in_team", {{"order", odd}}}}});
    states.push_back(state_of(1.0, {{"robot", odd}, {"alive", odd}, {"status", odd}, {"here", odd}}));
    states.push_back(state_of(1.0, {{"robot", 1}, {"status", {{"duty", odd}}}, {"here", {{"claim", odd}}}}));
    states.push_back({1.0, {{"in_team", {{"order", {{"acknowledged", odd}, {"refused", odd}}}}}}});
  }
  EXPECT_LE(team_news(states).size(), 1U) << "an array is an answer, whatever is in it";
}

}  // namespace
}  // namespace topo::daemon

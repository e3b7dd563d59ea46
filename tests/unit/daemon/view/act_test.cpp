// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/act.hpp"

#include <gmock/gmock.h>

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;

std::string fault(const std::string& text) {
  const auto act = parse_act(text);
  EXPECT_FALSE(act.has_value()) << text;
  return act ? "" : act.error().message;
}

TEST(ParseAct, AnEstopIsForTheWholeTeam) {
  const auto act = parse_act(R"({"act": "estop", "id": 7})");
  ASSERT_TRUE(act.has_value());
  EXPECT_EQ(act->kind, Act::Kind::kEstop);
  EXPECT_EQ(act->id, 7U);
  EXPECT_EQ(act->method, "estop");
  EXPECT_EQ(act->params, (Json{{"all", true}}));
}

TEST(ParseAct, AnEstopWithMistakesIsDone) {
  for (const char* text : {R"({"act": "estop"})", R"({"act": "estop", "id": -3, "x": []})"}) {
    const auto act = parse_act(text);
    ASSERT_TRUE(act.has_value()) << text;
    EXPECT_EQ(act->kind, Act::Kind::kEstop);
  }
}

TEST(ParseAct, CommandsAreTheDaemonsMethods) {
  for (const std::string name : {"start", "home", "pause", "resume", "clear_estop"}) {
    const auto act = parse_act(R"({"id": 1, "act": ")" + name + "\"}");
    ASSERT_TRUE(act.has_value()) << name;
    EXPECT_EQ(act->kind, Act::Kind::kCommand);
    EXPECT_EQ(act->method, name);
    EXPECT_TRUE(act->params.empty());
  }
  EXPECT_EQ(parse_act(R"({"id": 1, "act": "stop_all"})")->params, (Json{{"all", true}}));
}

TEST(ParseAct, AMissionIsOfThisRobotOfAMateOrOfAll) {
  for (const std::string name : {"start", "home", "pause", "resume"}) {
    const auto one = parse_act(R"({"id": 1, "robot": 3, "act": ")" + name + "\"}");
    ASSERT_TRUE(one.has_value()) << name;
    EXPECT_EQ(one->method, name);
    EXPECT_EQ(one->params, (Json{{"robot", 3}}));
    const auto all = parse_act(R"({"id": 1, "act": ")" + name + "_all\"}");
    ASSERT_TRUE(all.has_value()) << name;
    EXPECT_EQ(all->method, name);
    EXPECT_EQ(all->params, (Json{{"all", true}}));
  }
  EXPECT_THAT(fault(R"({"id": 1, "act": "start", "robot": -1})"), HasSubstr("robot: found -1"));
  for (const std::string name : {"clear_estop", "start_all", "stop_all"})
    EXPECT_THAT(fault(R"({"id": 1, "robot": 3, "act": ")" + name + "\"}"), HasSubstr("no single mate"));
}

TEST(ParseAct, NoOtherMethodOfTheDaemonIsReached) {
  for (const std::string name : {"drive", "map.save", "session.load", "config", "stop", "log_level"})
    EXPECT_THAT(fault(R"({"id": 1, "act": ")" + name + "\"}"), HasSubstr("act: expected"));
}

TEST(ParseAct, GotoNeedsAPlaceOnTheMap) {
  const auto act = parse_act(R"({"act": "goto", "id": 2, "x_m": 1.5, "y_m": -2, "all": true})");
  ASSERT_TRUE(act.has_value());
  EXPECT_EQ(act->params, (Json{{"x_m", 1.5}, {"y_m", -2.0}}));
  EXPECT_THAT(fault(R"({"act": "goto", "id": 2, "x_m": 1.5})"), HasSubstr("y_m"));
  EXPECT_THAT(fault(R"({"act": "goto", "id": 2, "x_m": 1e9, "y_m": 0})"), HasSubstr("x_m"));
}

TEST(ParseAct, AnAreaIsAListOfCorners) {
  const auto act = parse_act(R"({"act": "area_draw", "id": 2, "corners_m": [0, 0, 1.5, 0, 1, -1]})");
  ASSERT_TRUE(act.has_value());
  EXPECT_EQ(act->method, "area.draw");
  EXPECT_EQ(act->params, (Json{{"corners_m", {0.0, 0.0, 1.5, 0.0, 1.0, -1.0}}}));
  EXPECT_THAT(fault(R"({"act": "area_draw", "id": 2, "corners_m": [1, 2, 3]})"), HasSubstr("corners_m"));
  EXPECT_THAT(fault(R"({"act": "area_draw", "id": 2, "corners_m": [1, "2"]})"), HasSubstr("corners_m"));
  EXPECT_THAT(fault(R"({"act": "area_draw", "id": 2})"), HasSubstr("missing"));
  Json largest{{"act", "area_draw"}, {"id", 1ULL << 53U}, {"corners_m", std::vector<double>(120, -1234.567)}};
  EXPECT_TRUE(parse_act(largest.dump()).has_value()) << "it fits in a message";
  largest["corners_m"].push_back(0);
  largest["corners_m"].push_back(0);
  EXPECT_THAT(fault(largest.dump()), HasSubstr("at most 60"));
}

TEST(ParseAct, AnAreaIsWithdrawnByItsId) {
  const auto act = parse_act(R"({"act": "area_withdraw", "id": 2, "area": "2.77.3"})");
  ASSERT_TRUE(act.has_value());
  EXPECT_EQ(act->method, "area.withdraw");
  EXPECT_EQ(act->params, (Json{{"id", "2.77.3"}}));
  EXPECT_THAT(fault(R"({"act": "area_withdraw", "id": 2})"), HasSubstr("area"));
  EXPECT_THAT(fault(R"({"act": "area_withdraw", "id": 2, "area": ")" + std::string(65, '1') + "\"}"),
              HasSubstr("65"));
}

TEST(ParseAct, AnAreaMayBeOneToGoToFirst) {
  const std::string corners = R"("corners_m": [0, 0, 1.5, 0, 1, -1])";
  const auto act = parse_act(R"({"act": "area_draw", "id": 2, "kind": "here_first", )" + corners + "}");
  ASSERT_TRUE(act.has_value());
  EXPECT_EQ(act->params["kind"], "here_first");
  EXPECT_THAT(fault(R"({"act": "area_draw", "id": 2, "kind": "x", )" + corners + "}"),
              HasSubstr("here_first"));
  EXPECT_THAT(fault(R"({"act": "area_draw", "id": 2, "kind": 1, )" + corners + "}"), HasSubstr("kind"));
}

TEST(ParseAct, APoseHasAHeading) {
  const auto act = parse_act(R"({"act": "set_pose", "id": 2, "x_m": 1.5, "y_m": -2, "theta_rad": 0.5})");
  ASSERT_TRUE(act.has_value());
  EXPECT_EQ(act->method, "session.confirm");
  EXPECT_EQ(act->params, (Json{{"x_m", 1.5}, {"y_m", -2.0}, {"theta_rad", 0.5}}));
  EXPECT_THAT(fault(R"({"act": "set_pose", "id": 2, "x_m": 1.5, "y_m": -2})"), HasSubstr("theta_rad"));
}

TEST(ParseAct, AWishOfTheTimeLineIsNoMethodOfTheDaemon) {
  const auto act = parse_act(R"({"act": "replay", "id": 2, "position_s": 1.5, "speed": 2, "other": 3})");
  ASSERT_TRUE(act.has_value());
  EXPECT_EQ(act->kind, Act::Kind::kReplay);
  EXPECT_EQ(act->method, "");
  EXPECT_EQ(act->params, (Json{{"position_s", 1.5}, {"speed", 2}}));
}

TEST(ParseAct, ATokenIsShort) {
  EXPECT_EQ(parse_act(R"({"act": "authorise", "id": 2, "token": "abcd"})")->token, "abcd");
  EXPECT_THAT(fault(R"({"act": "authorise", "id": 2, "token": ")" + std::string(65, 'a') + "\"}"),
              HasSubstr("65"));
  EXPECT_THAT(fault(R"({"act": "authorise", "id": 2})"), HasSubstr("token"));
}

TEST(ParseAct, AnythingElseIsRefused) {
  EXPECT_THAT(fault("[]"), HasSubstr("object"));
  EXPECT_THAT(fault("{"), HasSubstr("object"));
  EXPECT_THAT(fault(R"({"act": 3, "id": 1})"), HasSubstr("act"));
  EXPECT_THAT(fault(R"({"act": "start", "id": 1.5})"), HasSubstr("id"));
  EXPECT_THAT(fault(std::string(kMaxActBytes + 1, ' ')), HasSubstr("2049"));
  EXPECT_THAT(fault(std::string(500, '[')), HasSubstr("flat"));
}

}  // namespace
}  // namespace topo::daemon

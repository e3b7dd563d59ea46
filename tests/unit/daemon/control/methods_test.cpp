// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/methods.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/unit/daemon/control/fake_operations.hpp"

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class MethodsTest : public ::testing::Test {
 protected:
  std::optional<Answer> ask(const std::string& method, Json params, bool may_command = true) {
    return methods.answer({1, may_command, {method, std::move(params), 1, false}});
  }
  RpcCode refusal(const std::string& method, Json params, bool may_command = true) {
    const auto answer = ask(method, std::move(params), may_command);
    EXPECT_TRUE(answer.has_value() && !answer->has_value());
    return answer && !*answer ? answer->error().code : RpcCode::kInternalError;
  }

  FakeOperations operations;
  std::optional<Answer> late;
  std::vector<std::uint64_t> subscribers;
  Methods methods{operations, [this](const Call&, const Answer& answer) { late = answer; },
                  [this](std::uint64_t client) { subscribers.push_back(client); }};
};

TEST_F(MethodsTest, TheTeamIsStoppedWhenAllIsSaid) {
  EXPECT_EQ((**ask("estop", {{"all", true}}, false))["order"], 7) << "anybody may";
  EXPECT_EQ((**ask("stop", {{"all", true}}))["order"], 8);
  EXPECT_TRUE((*ask("stop", {{"all", false}}))->empty());
  EXPECT_EQ(refusal("stop", {{"all", true}}, false), RpcCode::kForbidden);
  EXPECT_THAT(operations.calls, ElementsAre("estop_team", "stop_team", "stop"));
}

TEST_F(MethodsTest, AMissionIsOfThisRobotOfAMateOrOfAll) {
  EXPECT_EQ((**ask("start", {{"robot", 3}}))["order"], 8);
  EXPECT_EQ((**ask("home", {{"all", true}}))["order"], 8);
  EXPECT_TRUE((*ask("resume", Json::object()))->empty());
  EXPECT_THAT(operations.calls, ElementsAre("start to 3", "home_team", "resume"));
  EXPECT_EQ(refusal("pause", {{"robot", 3}, {"all", true}}), RpcCode::kInvalidParams);
  EXPECT_EQ(refusal("pause", {{"robot", 70'000}}), RpcCode::kInvalidParams);
  EXPECT_EQ(refusal("pause", {{"robot", "3"}}), RpcCode::kInvalidParams);
  EXPECT_EQ(refusal("start", {{"robot", 3}}, false), RpcCode::kForbidden);
  EXPECT_EQ(operations.calls.size(), 3U);
  operations.outcome = types::fail(types::Errc::kBusy, "robot 3 is out of reach");
  EXPECT_EQ(refusal("start", {{"robot", 3}}), RpcCode::kRefused);
}

TEST_F(MethodsTest, AnEstopWithAMistakeStopsThisRobot) {
  EXPECT_EQ(refusal("estop", {{"all", "yes"}}), RpcCode::kInvalidParams);
  EXPECT_THAT(operations.calls, ElementsAre("estop"));
}

TEST_F(MethodsTest, AnybodyMayLookAndEstop) {
  for (const auto* method : {"status", "version", "health", "latency", "config", "estop", "goals", "places",
                             "team", "progress", "areas", "map.doubt", "scan", "events.subscribe"}) {
    const auto answer = ask(method, Json::object(), false);
    ASSERT_TRUE(answer.has_value() && answer->has_value()) << method;
  }
  EXPECT_THAT(operations.calls, ElementsAre("estop"));
}

TEST_F(MethodsTest, AnAreaIsDrawnAndWithdrawn) {
  EXPECT_EQ((**ask("area.draw", {{"corners_m", {0, 0, 1.5, 0, 1, 1}}}))["id"], "7");
  EXPECT_EQ(operations.polygon, (types::Polygon{{0.0, 0.0}, {1.5, 0.0}, {1.0, 1.0}}));
  EXPECT_TRUE(ask("area.withdraw", {{"id", "7"}})->has_value());
  EXPECT_TRUE(ask("area.draw", {{"corners_m", {0, 0, 1.5, 0, 1, 1}}, {"kind", "here_first"}})->has_value());
  EXPECT_EQ(operations.area_kind, types::AreaKind::kHereFirst);
  EXPECT_EQ(refusal("area.draw", {{"corners_m", {0, 0, 1.5, 0, 1, 1}}, {"kind", "other"}}),
            RpcCode::kInvalidParams);
  EXPECT_THAT(operations.calls, ElementsAre("withdraw 7"));
  for (const Json& corners :
       {Json(), Json{1, 2, 3}, Json{"0", "0"}, Json(std::vector<double>(122, 0.0)), Json{1e6, 0}})
    EXPECT_EQ(refusal("area.draw", {{"corners_m", corners}}), RpcCode::kInvalidParams) << corners;
  EXPECT_EQ(refusal("area.withdraw", {{"id", 7}}), RpcCode::kInvalidParams);
  operations.outcome = types::fail(types::Errc::kBusy, "there are enough");
  EXPECT_EQ(refusal("area.draw", {{"corners_m", {0, 0, 1, 0, 1, 1}}}), RpcCode::kRefused);
}

TEST_F(MethodsTest, CommandsNeedTheRight) {
  EXPECT_EQ(refusal("drive", {{"v_mps", 0.1}, {"omega_radps", 0.0}}, false), RpcCode::kForbidden);
  EXPECT_EQ(refusal("stop", Json::object(), false), RpcCode::kForbidden);
  EXPECT_EQ(refusal("clear_estop", Json::object(), false), RpcCode::kForbidden);
  EXPECT_EQ(refusal("log_level", {{"level", "debug"}}, false), RpcCode::kForbidden);
  EXPECT_EQ(refusal("map.save", {{"dir", "/tmp"}}, false), RpcCode::kForbidden);
  EXPECT_THAT(operations.calls, IsEmpty());
  for (const auto* method : {"start", "home", "pause", "resume"})
    EXPECT_EQ(refusal(method, Json::object(), false), RpcCode::kForbidden) << method;
  EXPECT_EQ(refusal("goto", {{"x_m", 1}, {"y_m", 1}}, false), RpcCode::kForbidden);
  EXPECT_EQ(refusal("area.draw", {{"corners_m", {0, 0, 1, 0, 1, 1}}}, false), RpcCode::kForbidden);
  EXPECT_EQ(refusal("area.withdraw", {{"id", "1"}}, false), RpcCode::kForbidden);
  EXPECT_TRUE(operations.polygon.empty());
  EXPECT_FALSE(operations.save_done);
  EXPECT_FALSE(operations.goto_done);
}

TEST_F(MethodsTest, DriveTakesTwoNumbers) {
  ASSERT_TRUE(ask("drive", {{"v_mps", 0.25}, {"omega_radps", -1}})->has_value());
  EXPECT_EQ(operations.twist, (types::Twist2{0.25, -1.0}));
  EXPECT_EQ(refusal("drive", {{"v_mps", 0.25}}), RpcCode::kInvalidParams);
  EXPECT_EQ(refusal("drive", {{"v_mps", "x"}, {"omega_radps", 0}}), RpcCode::kInvalidParams);
  EXPECT_EQ(refusal("drive", {{"v_mps", 1}, {"omega_radps", 0}, {"w", 0}}), RpcCode::kInvalidParams);
}

TEST_F(MethodsTest, RefusalsCarryTheReason) {
  operations.outcome = types::fail(types::Errc::kBusy, "the stop button is pressed");
  const auto answer = ask("start", Json::object());
  ASSERT_TRUE(answer.has_value() && !answer->has_value());
  EXPECT_EQ(answer->error().code, RpcCode::kRefused);
  EXPECT_EQ(answer->error().message, "the stop button is pressed");
}

TEST_F(MethodsTest, ClearIsAnsweredWhenItIsDone) {
  EXPECT_FALSE(ask("clear_estop", Json::object()));
  EXPECT_THAT(operations.calls, ElementsAre("clear_estop"));
  ASSERT_TRUE(late.has_value());
  EXPECT_TRUE(late->has_value());
  operations.outcome = types::fail(types::Errc::kIo, "the disk is read-only");
  EXPECT_FALSE(ask("clear_estop", Json::object()));
  ASSERT_FALSE(late->has_value());
  EXPECT_EQ(late->error().message, "the disk is read-only");
}

TEST_F(MethodsTest, ClearThatAnEstopHasOvertakenIsNotDone) {
  const auto answer = methods.answer({1, true, {"clear_estop", Json::object(), 1, false}, true});
  ASSERT_TRUE(answer.has_value() && !answer->has_value());
  EXPECT_EQ(answer->error().code, RpcCode::kRefused);
  EXPECT_THAT(operations.calls, IsEmpty());
}

TEST_F(MethodsTest, MissionsAreGivenByName) {
  for (const auto* method : {"start", "pause", "resume", "home"})
    ASSERT_TRUE(ask(method, Json::object())->has_value()) << method;
  EXPECT_THAT(operations.calls, ElementsAre("explore", "pause", "resume", "home"));
  EXPECT_EQ(refusal("start", {{"fast", true}}), RpcCode::kInvalidParams);
}

TEST_F(MethodsTest, SessionsAreAnsweredLate) {
  for (const auto* method : {"session.save", "session.load"}) {
    EXPECT_EQ(refusal(method, {{"name", "office"}}, false), RpcCode::kForbidden) << method;
    EXPECT_EQ(refusal(method, Json::object()), RpcCode::kInvalidParams) << method;
  }
  EXPECT_EQ(refusal("session.new", Json::object(), false), RpcCode::kForbidden);
  EXPECT_FALSE(operations.save_done);
  EXPECT_FALSE(ask("session.list", Json::object(), false).has_value());
  ASSERT_TRUE(late && late->has_value());
  EXPECT_TRUE((**late).contains("sessions"));
  EXPECT_FALSE(ask("session.save", {{"name", "office"}}).has_value());
  EXPECT_EQ(operations.folder, "office");
  operations.save_done(types::fail(types::Errc::kIo, "the disk is full"));
  ASSERT_TRUE(late && !late->has_value());
  EXPECT_EQ(late->error().message, "the disk is full");
  ASSERT_TRUE(ask("session.new", Json::object())->has_value());
  EXPECT_THAT(operations.calls, ElementsAre("new"));
}

TEST_F(MethodsTest, ASessionIsLoadedAnywhereOrAroundAWholePose) {
  EXPECT_FALSE(ask("session.load", {{"name", "office"}}).has_value());
  EXPECT_FALSE(operations.pose);
  EXPECT_FALSE(
      ask("session.load", {{"name", "office"}, {"x_m", 1.5}, {"y_m", -2}, {"theta_rad", 7.0}}).has_value());
  ASSERT_TRUE(operations.pose);
  EXPECT_EQ(operations.pose->x_m, 1.5);
  EXPECT_NEAR(operations.pose->theta_rad, 7.0 - 2.0 * std::numbers::pi, 1e-12);
  EXPECT_FALSE(ask("session.confirm", Json::object()).has_value());
  EXPECT_FALSE(operations.pose);
  EXPECT_FALSE(ask("session.confirm", {{"x_m", 1.5}, {"y_m", -2}, {"theta_rad", 7.0}}).has_value());
  ASSERT_TRUE(operations.pose);
  EXPECT_EQ(operations.pose->y_m, -2.0);
  EXPECT_EQ(refusal("session.confirm", {{"y_m", 1.5}}), RpcCode::kInvalidParams);
  EXPECT_EQ(refusal("session.confirm", Json::object(), false), RpcCode::kForbidden);
  EXPECT_EQ(refusal("session.load", {{"name", "office"}, {"x_m", 1.5}}), RpcCode::kInvalidParams);
  EXPECT_EQ(refusal("session.load", {{"name", "office"}, {"at", 1}}), RpcCode::kInvalidParams);
}

TEST_F(MethodsTest, TheMapIsForEverybodyAndByItsChanges) {
  EXPECT_FALSE(ask("map.tiles", {{"since", 41}}, false).has_value());
  ASSERT_TRUE(late && late->has_value());
  EXPECT_EQ((**late)["revision"], 42);
  EXPECT_FALSE(ask("map.tiles", Json::object(), false).has_value());
  EXPECT_EQ((**late)["revision"], 1) << "all of it";
  EXPECT_FALSE(ask("map.trails", Json::object(), false).has_value());
  EXPECT_TRUE((**late).contains("own"));
  for (const Json& since : {Json(-1), Json(1.5), Json("1"), Json(1ULL << 60U)})
    EXPECT_EQ(refusal("map.tiles", {{"since", since}}), RpcCode::kInvalidParams) << since;
  EXPECT_EQ(refusal("map.tiles", {{"until", 1}}), RpcCode::kInvalidParams);
}

TEST_F(MethodsTest, GotoIsAnsweredWhenTheWayWasLookedFor) {
  EXPECT_EQ(refusal("goto", {{"x_m", 1.0}}), RpcCode::kInvalidParams);
  EXPECT_FALSE(ask("goto", {{"x_m", 1.5}, {"y_m", -2}}).has_value());
  EXPECT_EQ(operations.target, (types::Vector2{1.5, -2.0}));
  EXPECT_FALSE(late.has_value());
  operations.goto_done(types::fail(types::Errc::kUnsupported, "unknown space"));
  ASSERT_TRUE(late.has_value() && !late->has_value());
  EXPECT_EQ(late->error().code, RpcCode::kRefused);
  EXPECT_EQ(late->error().message, "unknown space");
}

TEST_F(MethodsTest, PlacesBeyondAnyMapAreNotGoneTo) {
  EXPECT_EQ(refusal("goto", {{"x_m", -1e300}, {"y_m", 0}}), RpcCode::kInvalidParams);
  EXPECT_EQ(refusal("session.load", {{"name", "office"}, {"x_m", 0}, {"y_m", 1e6}, {"theta_rad", 0}}),
            RpcCode::kInvalidParams);
  EXPECT_FALSE(operations.goto_done);
  EXPECT_FALSE(operations.pose);
}

TEST_F(MethodsTest, SubscribersGetWhatHoldsNow) {
  const auto answer = ask("events.subscribe", Json::object(), false);
  ASSERT_TRUE(answer.has_value() && answer->has_value());
  EXPECT_EQ((**answer)["ready"], true);
  EXPECT_THAT(subscribers, ElementsAre(1U));
}

TEST_F(MethodsTest, UnknownMethod) { EXPECT_EQ(refusal("fly", Json::object()), RpcCode::kMethodNotFound); }

TEST_F(MethodsTest, SavingAnswersLate) {
  EXPECT_FALSE(ask("map.save", {{"dir", "/somewhere"}}).has_value());
  EXPECT_EQ(operations.folder, "/somewhere");
  EXPECT_FALSE(late.has_value());
  operations.save_done(Json{{"files", 3}});
  ASSERT_TRUE(late.has_value() && late->has_value());
  EXPECT_EQ((**late)["files"], 3);
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/mission_log.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

std::vector<Json> parsed(const std::string& lines) {
  std::vector<Json> all;
  std::istringstream in(lines);
  for (std::string line; std::getline(in, line);) all.push_back(Json::parse(line));
  return all;
}

class MissionLogTest : public ::testing::Test {
 protected:
  LogLines lines;
  types::Stamp begin = types::stamp_from_seconds(100.0);
  MissionLog log{lines, begin};
  Json status{{"state", "driving"},
              {"pose", {{"x_m", 1.0}, {"y_m", 2.0}, {"theta_rad", 0.5}}},
              {"goal", {{"x_m", 3.0}}},
              {"reason", "west side of place 2"},
              {"devices", {{"base", "ready"}}},
              {"plausibility", {{"doubts", {{{"name", "late"}, {"cure", "look at the cable"}}}}}},
              {"map", {{"revision", 7}, {"keyframes", 5}, {"cells", 1000}}}};
};

TEST_F(MissionLogTest, aStateIsDueOnceASecond) {
  ASSERT_TRUE(log.is_due(begin));
  log.note_state(begin, status, Json::object());
  EXPECT_FALSE(log.is_due(begin + 999ms));
  EXPECT_TRUE(log.is_due(begin + 1s));
}

TEST_F(MissionLogTest, aStateSaysWhatTheRobotDoesAndWhy) {
  log.note_state(begin + 2500ms, status, Json::object());
  const auto all = parsed(lines.take());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0]["kind"], "state");
  EXPECT_DOUBLE_EQ(all[0]["t_s"].get<double>(), 2.5);
  EXPECT_EQ(all[0]["pose"], status["pose"]);
  EXPECT_EQ(all[0]["reason"], "west side of place 2");
  EXPECT_EQ(all[0]["doubts"], Json::array({"late"}));
  EXPECT_EQ(all[0]["map"], (Json{{"revision", 7}, {"keyframes", 5}}));
  EXPECT_FALSE(all[0].contains("devices")) << "small: a line a second for hours";
  EXPECT_FALSE(all[0].contains("team"));
  EXPECT_EQ(all[0]["utc"].get<std::string>().size(), std::string("2026-01-01T00:00:00Z").size());
}

TEST_F(MissionLogTest, aStateSaysWhatIsKnownOfMates) {
  const Json team{
      {"present", true},
      {"exchange", {{"sent", 1}}},
      {"peers", {{{"robot", 2}, {"alive", true}, {"heard_s_ago", 0.2}, {"it_lacks", 3}, {"here", nullptr}}}}};
  log.note_state(begin, status, team);
  EXPECT_EQ(parsed(lines.take())[0]["team"],
            Json::array({{{"robot", 2}, {"alive", true}, {"heard_s_ago", 0.2}}}));
}

TEST_F(MissionLogTest, aStateSaysWhereAMateIsButNotItsWay) {
  const Json pose{{"x_m", 1.0}, {"y_m", 2.0}, {"theta_rad", 0.5}};
  const Json team{
      {"peers", {{{"robot", 2}, {"here", {{"pose", pose}, {"claim", nullptr}, {"way", {pose, pose}}}}}}}};
  log.note_state(begin, status, team);
  EXPECT_EQ(parsed(lines.take())[0]["team"],
            Json::array({{{"robot", 2}, {"here", {{"pose", pose}, {"claim", nullptr}}}}}));
}

TEST_F(MissionLogTest, aStateSaysHowManyKeyframesOfAllAreInTheMap) {
  status["map"]["keyframes_of_all"] = 9;
  log.note_state(begin, status, Json::object());
  EXPECT_EQ(parsed(lines.take())[0]["map"],
            (Json{{"revision", 7}, {"keyframes", 5}, {"keyframes_of_all", 9}}));
}

TEST_F(MissionLogTest, aStateSaysWhichOrderToMatesWasObeyed) {
  Json team{{"present", true},  {"robot", 1},
            {"name", "office"}, {"peers", Json::array()},
            {"trouble", ""},    {"order", {{"number", 0}, {"acknowledged", Json::array()}}}};
  log.note_state(begin, status, team);
  EXPECT_EQ(parsed(lines.take())[0]["in_team"], (Json{{"robot", 1}})) << "small: none was given";
  team["order"]["number"] = 3;
  team["order"]["acknowledged"] = Json::array({2});
  team["trouble"] = "no link";
  log.note_state(begin, status, team);
  EXPECT_EQ(parsed(lines.take())[0]["in_team"],
            (Json{{"robot", 1}, {"order", team["order"]}, {"trouble", "no link"}}));
}

TEST_F(MissionLogTest, eventsKeepTheirMembersAndOrder) {
  log.note_event(begin + 1s, {{"event", "decision"}, {"text", "taken: gap \xff of 2 m"}});
  log.note_event(begin + 2s, {{"event", "done"}});
  const auto all = parsed(lines.take());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["kind"], "event");
  EXPECT_EQ(all[0]["event"], "decision");
  EXPECT_EQ(all[0]["text"], "taken: gap \xef\xbf\xbd of 2 m") << "not UTF-8: replaced";
  EXPECT_EQ(all[1]["event"], "done");
}

TEST_F(MissionLogTest, withoutRoomLinesAreLostAndCounted) {
  const std::string text(1000, 'x');
  for (int i = 0; i < 2000; ++i) log.note_event(begin, {{"event", "decision"}, {"text", text}});
  EXPECT_GT(log.lost(), 0U);
  EXPECT_LE(lines.take().size(), LogLines::kBytesMax);
  const std::uint64_t lost = log.lost();
  log.note_event(begin, {{"event", "done"}});
  EXPECT_EQ(log.lost(), lost) << "there is room again";
}

}  // namespace
}  // namespace topo::daemon

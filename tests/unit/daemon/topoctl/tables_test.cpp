// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/topoctl/tables.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Tables, GoalsAndWhy) {
  const Json goals{{"goal", {{"x_m", 1.0}, {"y_m", 2.0}, {"place", 3}, {"opening_m", 1.9}}},
                   {"open", Json::array()},
                   {"given_up",
                    {{{"x_m", 4.0}, {"y_m", 5.0}, {"back_in_s", 12.0}, {"why", "stuck"}},
                     {{"x_m", 8.0}, {"y_m", 9.0}, {"back_in_s", nullptr}, {"why", "no progress"}}}},
                   {"dropped", {{{"x_m", 6.0}, {"y_m", 7.0}, {"why", "visited"}}}},
                   {"decisions", {{{"x_m", 1.0}, {"y_m", 2.0}, {"age_s", 9.0}, {"text", "taken: nearest"}}}}};
  EXPECT_THAT(goals_table(goals), HasSubstr("(1.00, 2.00)  place 3, opening 1.90 m"));
  EXPECT_THAT(goals_table(goals), HasSubstr("(4.00, 5.00)  back in 12 s: stuck"));
  EXPECT_THAT(goals_table(goals), HasSubstr("(8.00, 9.00)  for good: no progress"));
  EXPECT_THAT(goals_table(goals), Not(HasSubstr("visited")));
  EXPECT_THAT(why_table(goals), HasSubstr("visited"));
  EXPECT_THAT(why_table(goals), HasSubstr("9 s ago"));
  EXPECT_EQ(goals_table(Json::object()), "no goals\n");
}

TEST(Tables, WatchLineIsOneLineWhateverIsMissing) {
  EXPECT_THAT(watch_line(Json::object()), Not(HasSubstr("\n")));
  const Json status{{"activity", "exploring"},
                    {"known_m2", 12.34},
                    {"state", "driving"},
                    {"mission", {{"elapsed_s", 75.0}, {"distance_m", 3.0}}}};
  EXPECT_THAT(watch_line(status), HasSubstr("1:15 exploring"));
  EXPECT_THAT(watch_line(status), HasSubstr("12.3 m2"));
  EXPECT_THAT(watch_line(status), Not(HasSubstr("driving")));
}

TEST(Tables, StatusSaysHowTheSessionFares) {
  Json status{
      {"session",
       {{"folder", "/s"},
        {"obstacle", ""},
        {"journal", {{"name", "journal-1"}, {"keyframes", 7}, {"failing", false}, {"failures", 0}}}}}};
  EXPECT_THAT(status_table(status), HasSubstr("session     7 keyframes in journal-1\n"));
  status["session"]["journal"]["failing"] = true;
  status["session"]["journal"]["failures"] = 4;
  status["session"]["journal"]["message"] = "the disk is full";
  EXPECT_THAT(status_table(status), HasSubstr("session     NOT being kept, 4 failures: the disk is full\n"));
  status["session"]["place"] = {{"on_trial", true},
                                {"session", "office"},
                                {"trial", {{"way_m", 1.25}, {"matched", 9}, {"contradicted", 1}}}};
  EXPECT_THAT(
      status_table(status),
      HasSubstr("place       on trial in session office for 1.2 m: 9 scans match it, 1 contradict it\n"));
  status["session"]["place"]["on_trial"] = false;
  EXPECT_THAT(status_table(status), Not(HasSubstr("on trial")));
  status["session"]["obstacle"] = "cannot be used";
  EXPECT_THAT(status_table(status), HasSubstr("session     cannot be used\n"));
  status["session"]["folder"] = "";
  EXPECT_THAT(status_table(status), Not(HasSubstr("session")));
}

TEST(Tables, StatusSaysWhetherTheEstopIsKept) {
  Json status{{"estop", false}, {"estop_latch", {{"kept", ""}, {"why", ""}, {"since", ""}, {"file", "/f"}}}};
  EXPECT_THAT(status_table(status), HasSubstr("e-stop      no\n"));
  status["estop"] = true;
  status["estop_latch"]["kept"] = "not yet";
  EXPECT_THAT(status_table(status), HasSubstr("e-stop      yes; not kept over a restart yet\n"));
  status["estop_latch"]["kept"] = "no";
  status["estop_latch"]["why"] = "the disk is full";
  EXPECT_THAT(status_table(status),
              HasSubstr("e-stop      yes; NOT kept over a restart: the disk is full\n"));
  status["estop_latch"]["kept"] = "yes";
  status["estop_latch"]["since"] = "yesterday";
  EXPECT_THAT(status_table(status),
              HasSubstr("e-stop      yes; kept in /f; since before the start: yesterday\n"));
}

TEST(Tables, StatusGivesNoVoltageThatIsNotReported) {
  EXPECT_THAT(status_table({{"battery_v", 12.64}}), HasSubstr("battery     12.6 V\n"));
  EXPECT_THAT(status_table({{"battery_v", 0.0}}), HasSubstr("battery     voltage not reported\n"));
  EXPECT_THAT(status_table(Json::object()), HasSubstr("battery     voltage not reported\n"));
}

TEST(Tables, ASessionsFaultIsSaid) {
  Json answer{{"folder", "/s"}, {"sessions", {{{"name", "room"}, {"bytes", 1000}, {"written_s", 0}}}}};
  const std::string row = fmt::format("{:<36} {:>10}  1970-01-01 00:00:00", "room", "1.0");
  EXPECT_THAT(sessions_table(answer), HasSubstr(row + "\n"));
  answer["sessions"][0]["fault"] = "";
  EXPECT_THAT(sessions_table(answer), HasSubstr(row + "\n"));
  answer["sessions"][0]["fault"] = "too short";
  EXPECT_THAT(sessions_table(answer), HasSubstr(row + "  no session: too short\n"));
}

TEST(Tables, AnAreaHasItsIdAndCorners) {
  const Json areas{{"kept", false},
                   {"trouble", "the disk is full"},
                   {"areas", {{{"id", "1"}, {"robot", nullptr}, {"corners_m", {{0, 0.5}, {1, 0}, {1, 1}}}}}}};
  EXPECT_THAT(areas_table(areas), HasSubstr("(0.00, 0.50) (1.00, 0.00) (1.00, 1.00)"));
  EXPECT_THAT(areas_table(areas), HasSubstr("a restart does not find them"));
  EXPECT_THAT(areas_table(areas), HasSubstr("the disk is full"));
}

TEST(Tables, DoctorNamesTheCureOfWhatIsBad) {
  const Json doctor{{"checks",
                     {{{"check", "base"}, {"ok", true}, {"found", "ready"}, {"cure", ""}},
                      {{"check", "e-stop"}, {"ok", false}, {"found", "latched"}, {"cure", "clear it"}}}}};
  EXPECT_THAT(doctor_table(doctor), HasSubstr("BAD  e-stop"));
  EXPECT_THAT(doctor_table(doctor), HasSubstr("cure: clear it"));
}

TEST(Tables, DoctorWarnsOfWhatIsDaring) {
  const Json doctor{
      {"checks",
       {{{"check", "sonar"}, {"ok", true}, {"warning", true}, {"found", "off"}, {"safer", "on"}},
        {{"check", "speed"}, {"ok", true}, {"warning", false}, {"found", "0.7"}, {"safer", ""}}}}};
  EXPECT_EQ(doctor_table(doctor),
            fmt::format("warn {:<18} off\n     {:<18} on\nok   {:<18} 0.7\n", "sonar", "", "speed"));
}

TEST(Tables, Mission) {
  const Json mission{{"number", 2},      {"order", "explore"}, {"state", "failed"},
                     {"reason", "lost"}, {"elapsed_s", 10.0},  {"distance_m", 1.0}};
  EXPECT_EQ(mission_text(mission), "mission 2 (explore) failed: lost; 10 s, 1.0 m driven\n");
  for (const char* none : {"", "-"}) {
    EXPECT_EQ(mission_text({{"reason", none}}), "mission - (-) -; - s, - m driven\n");
  }
}

TEST(Tables, StatusSaysWhyTheMapIsDoubtedAndWhere) {
  Json status{{"map", {{"doubt", {{"why", "walls stand twice"}, {"look_again", Json::array()}}}}}};
  status["map"]["doubt"]["look_again"] = {
      {{"x_m", 1.04}, {"y_m", -2.0}}, {{"x_m", 3.0}}, {{"x_m", 5.0}, {"y_m", 6.0}}};
  EXPECT_THAT(status_table(status),
              HasSubstr("doubt       walls stand twice; places to look at again: (1.0, -2.0), (5.0, 6.0)\n"));
  status["map"]["doubt"]["why"] = "";
  EXPECT_THAT(status_table(status), Not(HasSubstr("doubt")));
  status["map"]["doubt"] = nullptr;
  EXPECT_THAT(status_table(status), Not(HasSubstr("doubt")));
}

}  // namespace
}  // namespace topo::daemon

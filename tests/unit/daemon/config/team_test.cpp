// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "daemon/config/key_table.hpp"
#include "tests/unit/daemon/config/sample.hpp"

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr std::string_view kNeeded = R"(name = "office"
id = 7
interface = "wlan0"
security = "off"
)";

std::string team(std::string_view lines) { return std::string(kSmallest) + "[team]\n" + std::string(lines); }
std::string team_with(std::string_view more) { return team(std::string(kNeeded) + std::string(more)); }

TEST(Team, NoneWithoutItsSection) {
  const auto loaded = parse_configuration(kSmallest, "f.toml");
  EXPECT_THAT(loaded.faults, IsEmpty());
  EXPECT_FALSE(loaded.values.team.present);
  EXPECT_EQ(loaded.values.robot.id, 1);
  EXPECT_EQ(effective_text(loaded).find("[team]"), std::string::npos);
}

TEST(Team, SmallestHasTheDefaults) {
  const auto loaded = parse_configuration(team_with(""), "f.toml");
  ASSERT_EQ(faults_text(loaded), "");
  const TeamConfig& t = loaded.values.team;
  EXPECT_TRUE(t.present);
  EXPECT_EQ(t.name, "office");
  EXPECT_EQ(t.interface, "wlan0");
  EXPECT_THAT(t.peers, IsEmpty());
  EXPECT_EQ(t.domain, 0);
  EXPECT_FALSE(t.secure());
  EXPECT_FALSE(t.start.has_value());
  EXPECT_EQ(t.socket, "/run/topometric/link.sock");
}

TEST(Team, TheRobotsNumberIsTheTeams) {
  EXPECT_EQ(parse_configuration(team_with(""), "f.toml").values.robot.id, 7);
  std::string both = team_with("");
  both.replace(0, 8, "[robot]\nid = 7\n");
  EXPECT_THAT(faults_of(both), IsEmpty());
  std::string other = team_with("");
  other.replace(0, 8, "[robot]\nid = 3\n");
  EXPECT_THAT(faults_of(other),
              ElementsAre(StartsWith("10:1: team.id contradicts robot.id (line 2): found 7 and 3")));
}

TEST(Team, TakesEveryKey) {
  const auto loaded = parse_configuration(team_with(R"(peers = ["10.0.0.2", "192.168.7.3"]
domain = 42
start = [1, -2.5, 90]
socket = "/tmp/link.sock"
)"),
                                          "f.toml");
  ASSERT_EQ(faults_text(loaded), "");
  const TeamConfig& t = loaded.values.team;
  EXPECT_THAT(t.peers, ElementsAre("10.0.0.2", "192.168.7.3"));
  EXPECT_EQ(t.domain, 42);
  ASSERT_TRUE(t.start.has_value());
  EXPECT_EQ(t.start->x_m, 1.0);
  EXPECT_EQ(t.start->y_m, -2.5);
  EXPECT_DOUBLE_EQ(t.start->theta_rad, std::numbers::pi / 2.0);
  EXPECT_EQ(t.socket, "/tmp/link.sock");
  const auto folder = parse_configuration(
      team("name = \"a\"\nid = 2\ninterface = \"lo\"\nsecurity = \"/etc/topometric/team\"\n"), "f.toml");
  ASSERT_EQ(faults_text(folder), "");
  EXPECT_TRUE(folder.values.team.secure());
}

TEST(Team, EffectiveTextReadsBackTheSame) {
  for (const char* start :
       {"\"unknown\"", "[0, 0, 0]", "[0.1, -33.333, 17.3]", "[1, 2, -180]", "[1, 2, 359.9]"}) {
    const auto loaded = parse_configuration(
        team_with(std::string("peers = [\"10.0.0.2\"]\nstart = ") + start + "\n"), "f.toml");
    ASSERT_EQ(faults_text(loaded), "") << start;
    const std::string text = effective_text(loaded);
    const auto again = parse_configuration(text, "again.toml");
    ASSERT_EQ(faults_text(again), "") << text;
    for (const auto& key : key_table())
      EXPECT_EQ(value_text(key, again.values), value_text(key, loaded.values)) << key.path << " " << start;
  }
}

TEST(Team, WhatIsMissingIsSaidAtOnce) {
  EXPECT_THAT(faults_of(team("")),
              ElementsAre(HasSubstr("team.id is missing, expected a whole number from 1 to 250"),
                          HasSubstr("team.interface is missing"), HasSubstr("team.name is missing"),
                          AllOf(StartsWith("7:2: team.security is missing"), HasSubstr("\"off\""))));
}

TEST(Team, FaultsNameWhatWasFoundAndWhatIsRight) {
  EXPECT_THAT(
      faults_of(team(R"(name = "two words"
id = 251
interface = "wlan 0"
security = "none"
peers = ["10.0.0.2", "robot-2"]
domain = 231
start = [1, 2]
socket = "link.sock"
)")),
      ElementsAre(StartsWith("8:8: team.name: found \"two words\", expected a string: 1 to 32 letters"),
                  StartsWith("9:6: team.id: found 251, expected a whole number from 1 to 250"),
                  StartsWith("10:13: team.interface: found \"wlan 0\", expected a string: a network"),
                  AllOf(StartsWith("11:12: team.security: found \"none\""), HasSubstr("or \"off\"")),
                  AllOf(StartsWith("12:22: team.peers: found a list of 2 values"),
                        HasSubstr("element 2 is \"robot-2\"")),
                  StartsWith("13:10: team.domain: found 231"),
                  AllOf(StartsWith("14:9: team.start: found a list of 2 values"), HasSubstr("\"unknown\"")),
                  StartsWith("15:10: team.socket: found \"link.sock\"")));
}

TEST(Team, PeersAreUnicastAddressesEachOnce) {
  for (const char* wrong : {"224.0.0.1", "239.255.0.1", "0.0.0.0", "255.255.255.255", "10.0.0", "::1", ""})
    EXPECT_THAT(faults_of(team_with(std::string("peers = [\"") + wrong + "\"]\n")),
                ElementsAre(HasSubstr("team.peers: found")))
        << wrong;
  EXPECT_THAT(faults_of(team_with("peers = [\"10.0.0.2\", \"10.0.0.3\", \"10.0.0.2\"]\n")),
              ElementsAre(StartsWith("12:1: team.peers: found 10.0.0.2 twice")));
  std::string many = "peers = [\"10.0.1.1\"";
  for (int i = 2; i <= 17; ++i) many += ", \"10.0.1." + std::to_string(i) + "\"";
  EXPECT_THAT(faults_of(team_with(many + "]\n")), ElementsAre(HasSubstr("a list of at most 16 strings")));
}

TEST(Team, StartIsAPoseOrUnknown) {
  for (const char* wrong : {"\"here\"", "[1, 2, inf]", "[1, 2, 361]", "[1, 20000, 0]", "[1, 2, \"3\"]", "7"})
    EXPECT_THAT(faults_of(team_with(std::string("start = ") + wrong + "\n")),
                ElementsAre(StartsWith("12:9: team.start: found")))
        << wrong;
}

TEST(Team, TheLinkHasASocketOfItsOwn) {
  EXPECT_THAT(faults_of(team_with("socket = \"/run//topometric/control.sock\"\n")),
              ElementsAre(StartsWith("12:1: team.socket contradicts control.socket (by default)")));
}

}  // namespace
}  // namespace topo::daemon

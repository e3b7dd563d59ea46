// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "daemon/topoctl/tables.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;

TEST(TeamTable, HasALineForEachMate) {
  const Json team{{"present", true},
                  {"name", "office"},
                  {"robot", 1},
                  {"security", "off"},
                  {"link", {{"joined", true}}},
                  {"held", {{"items", 12}, {"bytes", 51000}}},
                  {"trouble", ""},
                  {"peers",
                   {{{"robot", 2},
                     {"alive", true},
                     {"heard_s_ago", 0.4},
                     {"round_trip_s", 0.0123},
                     {"loss_in", 0.31},
                     {"it_lacks", {{"bytes", 4300}}},
                     {"lacks_here", {{"bytes", 0}}},
                     {"in_step", false},
                     {"map_joined", true},
                     {"status", {{"duty", "able"}, {"claim", {{"x_m", 4.0}, {"y_m", 5.5}}}}}},
                    {{"robot", 3}, {"alive", false}, {"heard_s_ago", 95.0}}}}};
  const std::string table = team_table(team);
  EXPECT_THAT(table, HasSubstr("office, this is robot 1, security off"));
  EXPECT_THAT(table, HasSubstr("12 ms"));
  EXPECT_THAT(table, HasSubstr("31 %"));
  EXPECT_THAT(table, HasSubstr("4.3 kB"));
  EXPECT_THAT(table, HasSubstr("able to 4.0 5.5"));
  EXPECT_THAT(table, HasSubstr("out of reach"));
}

TEST(TeamTable, WithoutATeamSaysSo) {
  EXPECT_THAT(team_table(Json{{"present", false}}), HasSubstr("[team]"));
  EXPECT_THAT(team_table(Json::object()), HasSubstr("[team]"));
}

}  // namespace
}  // namespace topo::daemon

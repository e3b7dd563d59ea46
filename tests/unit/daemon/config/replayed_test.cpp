// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/replayed.hpp"

#include <gmock/gmock.h>

#include "tests/unit/daemon/config/sample.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;

LoadedConfiguration of_a_robot_that_keeps_everything() {
  auto loaded = parse_configuration(std::string(kSmallest) + R"([exploration]
save_folder = "/maps"
[control]
state_folder = "/state"
[session]
folder = "/sessions"
resume = "last"
keep = 1
)",
                                    "f.toml");
  EXPECT_TRUE(loaded.faults.empty()) << faults_text(loaded);
  return loaded;
}

TEST(Replayed, ReadsAndWritesNothingOfTheRobots) {
  const LoadedConfiguration loaded = replayed(of_a_robot_that_keeps_everything(), "");
  EXPECT_EQ(loaded.values.session.folder, "");
  EXPECT_EQ(loaded.values.session.resume, "");
  EXPECT_EQ(loaded.values.exploration.save_folder, "");
  EXPECT_EQ(loaded.values.control.state_folder, "");
  EXPECT_THAT(effective_text(loaded), HasSubstr("resume = \"\"  # default"));
}

TEST(Replayed, HasNoTeam) {
  const std::string text =
      std::string(kSmallest) + "[team]\nname = \"a\"\nid = 9\ninterface = \"lo\"\nsecurity = \"off\"\n";
  const LoadedConfiguration loaded = replayed(parse_configuration(text, "f.toml"), "");
  EXPECT_FALSE(loaded.values.team.present);
  EXPECT_FALSE(loaded.places.contains("team.name"));
  EXPECT_EQ(loaded.values.robot.id, 9) << "the same robot";
}

TEST(Replayed, KeepsItsOwnSessionsWhereItIsTold) {
  const LoadedConfiguration loaded = replayed(of_a_robot_that_keeps_everything(), "scratch");
  EXPECT_EQ(loaded.values.session.folder, "scratch");
  EXPECT_EQ(loaded.values.session.resume, "") << "and goes on with none of them";
}

TEST(Replayed, IsTheSameRobotOtherwise) {
  LoadedConfiguration loaded = replayed(of_a_robot_that_keeps_everything(), "/sessions");
  loaded.values.session.resume = "last";
  loaded.values.exploration.save_folder = "/maps";
  loaded.values.control.state_folder = "/state";
  loaded.places = of_a_robot_that_keeps_everything().places;
  EXPECT_EQ(effective_text(loaded), effective_text(of_a_robot_that_keeps_everything()));
}

}  // namespace
}  // namespace topo::daemon

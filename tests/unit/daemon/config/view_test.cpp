// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "tests/unit/daemon/config/sample.hpp"

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string view(std::string_view lines) { return std::string(kSmallest) + "[view]\n" + std::string(lines); }

TEST(View, ThisMachineAloneReachesThePageByDefault) {
  const auto loaded = parse_configuration(kSmallest, "f.toml");
  EXPECT_THAT(loaded.faults, IsEmpty());
  EXPECT_EQ(loaded.values.view.address, "127.0.0.1");
  EXPECT_EQ(loaded.values.view.port, 8080);
  EXPECT_EQ(loaded.values.view.look, ViewLook::kEverybody);
}

TEST(View, TakesEveryKey) {
  const auto loaded = parse_configuration(view(R"(address = "::"
port = 80
hosts = ["robot1.example.org", "robot1"]
look = "token"
state_folder = "/tmp/view"
)"),
                                          "f.toml");
  ASSERT_EQ(faults_text(loaded), "");
  const ViewConfig& v = loaded.values.view;
  EXPECT_EQ(v.address, "::");
  EXPECT_EQ(v.port, 80);
  EXPECT_THAT(v.hosts, ElementsAre("robot1.example.org", "robot1"));
  EXPECT_EQ(v.look, ViewLook::kToken);
  EXPECT_EQ(v.state_folder, "/tmp/view");
}

TEST(View, WhatIsWrongIsSaid) {
  EXPECT_THAT(faults_of(view("address = \"robot1\"\n")), ElementsAre(HasSubstr("an IP address")));
  EXPECT_THAT(faults_of(view("address = \"127.0.0.1:8080\"\n")), ElementsAre(HasSubstr("view.address")));
  EXPECT_THAT(faults_of(view("port = 0\n")), ElementsAre(HasSubstr("from 1 to 65535")));
  EXPECT_THAT(faults_of(view("hosts = [\"http://robot1\"]\n")), ElementsAre(HasSubstr("a host's name")));
  EXPECT_THAT(faults_of(view("look = \"nobody\"\n")), ElementsAre(HasSubstr("everybody")));
  EXPECT_THAT(faults_of(view("state_folder = \"\"\n")), ElementsAre(HasSubstr("an absolute path")));
}

}  // namespace
}  // namespace topo::daemon

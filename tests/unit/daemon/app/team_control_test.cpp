// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/team_control.hpp"

#include <gmock/gmock.h>

#include <memory>

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TeamControlTest : public ::testing::Test {
 protected:
  TeamControlTest() {
    configuration.present = true;
    configuration.name = "office";
    configuration.id = 1;
    configuration.security = "off";
  }
  void report(const TeamReport& of_thread) {
    team->report.store(of_thread);
    control.tick(now);
  }
  /// What a link tells that dropped so many of a kind.
  void report_dropped(LinkDrop kind, std::uint64_t count) {
    TeamReport told;
    told.joined = true;
    told.link.emplace();
    told.link->dropped[static_cast<std::size_t>(kind)] = count;
    report(told);
  }

  TeamConfig configuration;
  types::Stamp now = types::stamp_from_seconds(100.0);
  std::unique_ptr<TeamHandOver> team = std::make_unique<TeamHandOver>();
  std::vector<std::pair<team::OrderKind, std::uint16_t>> obeyed;
  TeamControl control{configuration, *team,
                      [this](team::OrderKind kind, std::uint16_t from) { obeyed.emplace_back(kind, from); }};
};

TEST_F(TeamControlTest, AMatesOrderIsObeyedThenAcknowledged) {
  team::HeardOrder* slot = team->orders.try_acquire();
  ASSERT_NE(slot, nullptr);
  *slot = {{2, 7, 5}, {team::OrderKind::kEstop}, types::Duration::zero()};
  team->orders.commit();
  control.collect();
  EXPECT_THAT(obeyed, ElementsAre(std::pair(team::OrderKind::kEstop, std::uint16_t{2})));
  const TeamRequest* request = team->requests.front();
  ASSERT_NE(request, nullptr);
  ASSERT_TRUE(std::holds_alternative<OrderDone>(*request));
  EXPECT_EQ(std::get<OrderDone>(*request).order, (team::EntryId{2, 7, 5}));
}

TEST_F(TeamControlTest, OrdersAreNumberedAndWithoutATeamThereAreNone) {
  EXPECT_EQ(control.order(team::OrderKind::kStop), 1U);
  EXPECT_EQ(control.order(team::OrderKind::kEstop), 2U);
  EXPECT_EQ(std::get<TeamOrder>(*team->requests.front()).number, 1U);
  configuration.present = false;
  EXPECT_EQ(control.order(team::OrderKind::kEstop), 0U);
}

TEST_F(TeamControlTest, AFullWayIsNoOrderSent) {
  std::uint64_t last = 1;
  for (int i = 0; i < 64 && last != 0; ++i) last = control.order(team::OrderKind::kStop);
  EXPECT_EQ(last, 0U);
}

TEST_F(TeamControlTest, TellsWhyTheRobotIsAlone) {
  EXPECT_THAT(control.trouble(), HasSubstr("topometric-link"));
  TeamReport alone;
  alone.words = "the link is of another team";
  report(alone);
  EXPECT_THAT(control.trouble(), HasSubstr("another team"));
  TeamReport joined;
  joined.joined = true;
  report(joined);
  EXPECT_EQ(control.trouble(), "");
  joined.duplicates.push_back({1, 3, 4, true});
  report(joined);
  EXPECT_THAT(control.trouble(), HasSubstr("robot.id"));
  configuration.present = false;
  EXPECT_EQ(control.trouble(), "");
}

TEST_F(TeamControlTest, ARobotWithThisNumberIsToldAndNothingBegins) {
  report_dropped(LinkDrop::kOwnNumber, 0);
  EXPECT_EQ(control.trouble(), "");
  EXPECT_EQ(control.obstacle(), "");
  report_dropped(LinkDrop::kOwnNumber, 3);
  EXPECT_THAT(control.trouble(), HasSubstr("two robots have the number 1, which is this robot's"));
  EXPECT_EQ(control.obstacle(), control.trouble());
  EXPECT_EQ(control.facts()->trouble, control.trouble());
  now += std::chrono::seconds(6);
  report_dropped(LinkDrop::kOwnNumber, 3);
  EXPECT_EQ(control.trouble(), "") << "it has gone";
  report_dropped(LinkDrop::kOwnNumber, 1);
  EXPECT_NE(control.obstacle(), "") << "a new link counts from zero";
}

TEST_F(TeamControlTest, FalseCredentialsAreAWarning) {
  report_dropped(LinkDrop::kNotTrusted, 2);
  report_dropped(LinkDrop::kNotTrusted, 5);
  EXPECT_THAT(control.warning(), HasSubstr("5 handshakes were refused"));
  EXPECT_EQ(control.trouble(), "");
  EXPECT_EQ(control.obstacle(), "");
  EXPECT_EQ(control.facts()->warning, control.warning());
  now += std::chrono::seconds(61);
  report_dropped(LinkDrop::kNotTrusted, 5);
  EXPECT_EQ(control.warning(), "");
  configuration.present = false;
  EXPECT_FALSE(control.facts().has_value());
}

TEST_F(TeamControlTest, ShowsMatesWithWhatTheyLack) {
  TeamReport heard;
  heard.joined = true;
  team::PeerView peer;
  peer.robot = 2;
  peer.alive = true;
  peer.it_lacks_bytes = 4300;
  heard.peers.push_back(peer);
  heard.located.push_back(2);
  heard.statuses.push_back({});
  heard.statuses.back().message.robot = 2;
  heard.statuses.back().message.claim = team::Bid{{4.0, 5.0}, 9.0, true};
  report(heard);
  const Json json = control.json(types::Stamp{});
  ASSERT_EQ(json["peers"].size(), 1U);
  EXPECT_EQ(json["peers"][0]["it_lacks"]["bytes"], 4300);
  EXPECT_EQ(json["peers"][0]["map_joined"], true);
  EXPECT_EQ(json["peers"][0]["status"]["claim"]["x_m"], 4.0);
  EXPECT_EQ(control.brief()["alive"], 1);
}

}  // namespace
}  // namespace topo::daemon

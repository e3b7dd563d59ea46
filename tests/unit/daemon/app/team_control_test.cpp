// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/team_control.hpp"
#include "drivers/io/posix.hpp"

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
  /// An order of robot 2 arrives; what the giver is told of it.
  OrderDone heard(std::uint32_t number, team::OrderKind kind, std::optional<types::Duration> age) {
    team::HeardOrder* slot = team->orders.try_acquire();
    if (slot == nullptr) return {};
    *slot = {{2, number, 5}, {kind, std::uint16_t{1}}, age};
    team->orders.commit();
    control.collect();
    const TeamRequest* request = team->requests.front();
    const OrderDone done = request != nullptr ? std::get<OrderDone>(*request) : OrderDone{};
    team->requests.pop();
    return done;
  }
  void report_mate(std::uint16_t robot, bool alive) {
    TeamReport told;
    told.joined = true;
    team::PeerView peer;
    peer.robot = robot;
    peer.alive = alive;
    peer.heard = now - std::chrono::seconds(12);
    told.peers.push_back(peer);
    report(told);
  }

  std::vector<std::pair<team::OrderKind, std::uint16_t>> obeyed;
  types::Status outcome;
  TeamControl control{configuration, *team, [this](team::OrderKind kind, std::uint16_t from) {
                        obeyed.emplace_back(kind, from);
                        return outcome;
                      }};
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

TEST_F(TeamControlTest, WhatTheRobotRefusesTheGiverLearns) {
  outcome = types::fail(types::Errc::kBusy, "the e-stop is latched");
  EXPECT_EQ(heard(7, team::OrderKind::kStart, types::Duration::zero()).refused, "the e-stop is latched");
  EXPECT_EQ(obeyed.size(), 1U);
}

TEST_F(TeamControlTest, NoLateOrderSetsTheRobotInMotion) {
  const types::Duration late = std::chrono::seconds(3);
  for (const auto kind : {team::OrderKind::kStart, team::OrderKind::kResume, team::OrderKind::kHome}) {
    EXPECT_THAT(heard(7, kind, late).refused, HasSubstr("3 s late"));
    EXPECT_NE(heard(8, kind, std::nullopt).refused, "");
  }
  EXPECT_TRUE(obeyed.empty());
  for (const auto kind : {team::OrderKind::kStop, team::OrderKind::kEstop, team::OrderKind::kPause})
    EXPECT_EQ(heard(9, kind, late).refused, "");
  EXPECT_EQ(obeyed.size(), 3U) << "what stops is obeyed whenever it comes";
}

TEST_F(TeamControlTest, AStopIsNotUndoneByAnEarlierStart) {
  EXPECT_EQ(heard(8, team::OrderKind::kStop, types::Duration::zero()).refused, "");
  EXPECT_THAT(heard(7, team::OrderKind::kStart, types::Duration::zero()).refused, HasSubstr("later order"));
  EXPECT_EQ(heard(9, team::OrderKind::kStart, types::Duration::zero()).refused, "");
  EXPECT_EQ(obeyed.size(), 2U);
}

TEST_F(TeamControlTest, WhatWasGivenBeforeAHaltByWhomeverSetsNothingInMotion) {
  control.note_halt(io::monotonic_now());
  EXPECT_THAT(heard(7, team::OrderKind::kStart, std::chrono::milliseconds(500)).refused,
              HasSubstr("halted after"));
  EXPECT_TRUE(obeyed.empty());
  EXPECT_EQ(heard(8, team::OrderKind::kStart, types::Duration::zero()).refused, "");
}

TEST_F(TeamControlTest, AnOrderToOneNeedsThatOneInReach) {
  const auto fault = [&](std::uint16_t robot) {
    const auto sent = control.order_one(team::OrderKind::kStart, robot, now);
    return sent ? std::string() : sent.error().message;
  };
  EXPECT_THAT(fault(3), HasSubstr("robot 3 was not heard"));
  report_mate(3, false);
  EXPECT_THAT(fault(3), HasSubstr("robot 3 is out of reach, heard 12 s ago"));
  EXPECT_EQ(team->requests.front(), nullptr) << "nothing was sent";
  report_mate(3, true);
  EXPECT_EQ(fault(3), "");
  const auto& order = std::get<TeamOrder>(*team->requests.front()).order;
  EXPECT_EQ(order.kind, team::OrderKind::kStart);
  EXPECT_EQ(order.to, std::uint16_t{3});
  TeamReport told;
  told.order_to = 3;
  report(told);
  EXPECT_EQ(control.json(now)["order"]["to"], 3);
  report_mate(3, true);
  configuration.present = false;
  EXPECT_THAT(fault(3), HasSubstr("no team"));
}

TEST_F(TeamControlTest, TellsWhoRefusesAndWhy) {
  TeamReport told;
  told.order = 4;
  told.acknowledged = {2};
  told.refused = {{3, "there is no map yet"}};
  report(told);
  EXPECT_EQ(control.json(now)["order"],
            (Json{{"number", 4},
                  {"to", nullptr},
                  {"acknowledged", {2}},
                  {"refused", {{{"robot", 3}, {"why", "there is no map yet"}}}}}));
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

TEST_F(TeamControlTest, ShowsMatesInThisRobotsMapWhereItsFrameIsKnown) {
  TeamReport heard;
  heard.joined = true;
  for (const std::uint16_t robot : {std::uint16_t{2}, std::uint16_t{3}}) {
    team::PeerView peer;
    peer.robot = robot;
    heard.peers.push_back(peer);
  }
  team::StatusMessage mate;
  mate.robot = 3;
  mate.T_map_base = {1.0, 2.0, 0.5};
  mate.way_map = {{1.0, 2.0}, {3.0, 4.0}};
  heard.in_map.push_back(mate);
  report(heard);
  const Json json = control.json(types::Stamp{});
  EXPECT_TRUE(json["peers"][0]["here"].is_null());
  const Json& here = json["peers"][1]["here"];
  EXPECT_EQ(here["pose"], (Json{{"x_m", 1.0}, {"y_m", 2.0}, {"theta_rad", 0.5}}));
  EXPECT_EQ(here["way"][1]["y_m"], 4.0);
  EXPECT_TRUE(here["claim"].is_null());
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <memory>

namespace topo::team {
namespace {

News made_by(std::uint16_t robot, std::uint32_t sequence) {
  auto keyframe = std::make_shared<slam::Keyframe>();
  keyframe->id = {robot, sequence};
  News news{{{keyframe, {1.0 * sequence, 0.0, 0.0}}}, {}};
  if (sequence > 0)
    news.relations.push_back(
        {{robot, sequence - 1}, {{robot, sequence - 1}, {robot, sequence}}, {{0.4, 0.0, 0.0}}});
  return news;
}

const types::Se2* no_pose(const slam::KeyframeId& /*id*/) { return nullptr; }

void send(const Exchange& from, std::uint16_t sender, Exchange& to, std::uint16_t receiver) {
  (void)to.take(sender, from.letter_to(receiver, std::nullopt, no_pose));
}

bool are_equal(const Exchange& a, const Exchange& b) {
  return a.keyframes() == b.keyframes() && a.relations().counts() == b.relations().counts();
}

TEST(Exchange, WhatIsLostIsSentAgain) {
  Exchange a, b;
  a.add_own(made_by(1, 0));
  (void)a.letter_to(2, std::nullopt, no_pose);  // lost
  EXPECT_EQ(b.take(1, a.letter_to(2, std::nullopt, no_pose)).keyframes.size(), 1U);
}

TEST(Exchange, WhatTheReceiverHasIsNotSent) {
  Exchange a, b;
  a.add_own(made_by(1, 0));
  send(a, 1, b, 2);
  send(b, 2, a, 1);
  EXPECT_TRUE(a.letter_to(2, std::nullopt, no_pose).news.empty());
}

TEST(Exchange, ALetterTakenTwiceBringsNothingNew) {
  Exchange a, b;
  a.add_own(made_by(1, 0));
  const Letter letter = a.letter_to(2, std::nullopt, no_pose);
  EXPECT_FALSE(b.take(1, letter).empty());
  EXPECT_TRUE(b.take(1, letter).empty());
}

TEST(Exchange, ALetterIsBounded) {
  ExchangeParams params;
  params.keyframes_in_letter = 3;
  Exchange a(params);
  for (std::uint32_t i = 0; i < 10; ++i) a.add_own(made_by(1, i));
  EXPECT_EQ(a.letter_to(2, std::nullopt, no_pose).news.keyframes.size(), 3U);
}

TEST(Exchange, AThirdRobotGetsItByWayOfASecond) {
  Exchange a, b, c;
  a.add_own(made_by(1, 0));
  send(a, 1, b, 2);
  send(b, 2, c, 3);
  EXPECT_TRUE(are_equal(a, c));
}

TEST(Exchange, AllHaveTheSameInTheEndWhoeverMeetsWhom) {
  EXPECT_TRUE(rc::check([] {
    std::array<Exchange, 3> robots;
    std::array<std::uint32_t, 3> made{};
    const auto steps = *rc::gen::inRange(0, 60);
    for (int i = 0; i < steps; ++i) {
      const auto from = *rc::gen::inRange<std::uint16_t>(0, 3), to = *rc::gen::inRange<std::uint16_t>(0, 3);
      if (from == to)
        robots.at(from).add_own(made_by(from, made.at(from)++));
      else
        send(robots.at(from), from, robots.at(to), to);
    }
    for (int round = 0; round < 12; ++round) {  // a ring is enough
      for (std::uint16_t r = 0; r < 3; ++r) {
        const auto beside = static_cast<std::uint16_t>((r + 1) % 3);
        send(robots.at(r), r, robots.at(beside), beside);
        send(robots.at(beside), beside, robots.at(r), r);
      }
    }
    RC_ASSERT(are_equal(robots[0], robots[1]));
    RC_ASSERT(are_equal(robots[1], robots[2]));
  }));
}

TEST(InFrame, MovesEveryPlaceOfAMessage) {
  StatusMessage message;
  message.T_map_base = {1.0, 0.0, 0.0};
  message.home = types::Vector2(2.0, 0.0);
  message.claim = Bid{{3.0, 0.0}, 1.0};
  message.bids = {{{4.0, 0.0}, 1.0}};
  message.visited = message.looked = message.way_map = {{5.0, 0.0}};
  const types::Vector2 by(10.0, 20.0);
  const StatusMessage moved = in_frame({by.x(), by.y(), 0.0}, message);
  EXPECT_EQ(moved.T_map_base.translation(), types::Vector2(1.0, 0.0) + by);
  EXPECT_EQ(moved.start, message.start + by);
  EXPECT_EQ(*moved.home, *message.home + by);
  EXPECT_EQ(moved.claim->p_map, message.claim->p_map + by);
  EXPECT_EQ(moved.bids.front().p_map, message.bids.front().p_map + by);
  for (const auto* places : {&moved.visited, &moved.looked, &moved.way_map})
    EXPECT_EQ(places->front(), types::Vector2(5.0, 0.0) + by);
}

}  // namespace
}  // namespace topo::team

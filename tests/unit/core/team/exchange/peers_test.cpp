// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/peers.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::at;
using testing::kSelf;

const slam::Origin kMate{2, 1}, kMateAgain{2, 2};

TEST(Peers, ADatagramThatComesAgainIsRepeated) {
  Peers peers;
  EXPECT_EQ(peers.hear(kMate, 10, {}, at(0.0)), Hearing::kFresh);
  EXPECT_EQ(peers.hear(kMate, 12, {}, at(0.1)), Hearing::kFresh);
  EXPECT_EQ(peers.hear(kMate, 11, {}, at(0.2)), Hearing::kFresh) << "late, and not seen before";
  for (const std::uint32_t counter : {10U, 11U, 12U})
    EXPECT_EQ(peers.hear(kMate, counter, {}, at(0.3)), Hearing::kRepeated) << counter;
  EXPECT_EQ(peers.hear(kMate, 5'000, {}, at(0.4)), Hearing::kFresh);
  EXPECT_EQ(peers.hear(kMate, 13, {}, at(0.5)), Hearing::kRepeated) << "too old to tell";
}

TEST(Peers, CountersMayWrapAround) {
  Peers peers;
  EXPECT_EQ(peers.hear(kMate, 0xFFFF'FFFFU, {}, at(0.0)), Hearing::kFresh);
  EXPECT_EQ(peers.hear(kMate, 0, {}, at(0.0)), Hearing::kFresh);
  EXPECT_EQ(peers.hear(kMate, 0xFFFF'FFFFU, {}, at(0.0)), Hearing::kRepeated);
}

TEST(Peers, NoMoreThanTheCapAllows) {
  ExchangeParams params;
  params.caps.peers = 3;
  Peers peers;
  for (std::uint16_t robot = 0; robot < 5; ++robot)
    EXPECT_EQ(peers.hear({robot, 1}, 0, params, at(0.0)), robot < 3 ? Hearing::kFresh : Hearing::kTooMany);
  const types::Stamp later = at(params.periods.forget_s + 1.0);
  EXPECT_EQ(peers.hear({9, 1}, 0, params, later), Hearing::kFresh) << "the others are forgotten";
  EXPECT_EQ(peers.all().size(), 1U);
}

TEST(Peers, AreAliveForAWhile) {
  const PeriodParams periods;
  Peers peers;
  peers.hear(kMate, 0, {}, at(0.0));
  Peer& peer = *peers.find(kMate);
  EXPECT_TRUE(is_alive(peer, periods, at(periods.alive_s)));
  EXPECT_FALSE(is_alive(peer, periods, at(periods.alive_s + 0.1)));
  EXPECT_FALSE(hears_us(peer, periods, at(0.0)));
  peer.heard_us = at(0.0);
  EXPECT_TRUE(hears_us(peer, periods, at(0.0)));
}

TEST(Peers, ARestartIsNoDuplicate) {
  Peers peers;
  for (int i = 0; i < 100; ++i) peers.hear(kMate, static_cast<std::uint32_t>(i), {}, at(0.05 * i));
  for (int i = 0; i < 100; ++i) peers.hear(kMateAgain, static_cast<std::uint32_t>(i), {}, at(5.0 + 0.05 * i));
  for (const double t : {5.0, 6.0, 8.0, 10.0}) EXPECT_TRUE(peers.duplicates(kSelf, {}, at(t)).empty()) << t;
}

TEST(Peers, TwoRunsHeardTogetherAreADuplicate) {
  Peers peers;
  for (int i = 0; i < 40; ++i) {
    peers.hear(kMate, static_cast<std::uint32_t>(i), {}, at(0.05 * i));
    peers.hear(kMateAgain, static_cast<std::uint32_t>(i), {}, at(0.05 * i));
  }
  const auto found = peers.duplicates(kSelf, {}, at(2.0));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].robot, 2U);
  EXPECT_FALSE(found[0].own);
  EXPECT_TRUE(peers.duplicates(kSelf, {}, at(9.0)).empty()) << "both are gone";
}

TEST(Peers, OnlyTheDoubleOneIsDouble) {
  Peers peers;
  for (int i = 0; i < 40; ++i) {
    for (const slam::Origin& mate : {kMate, kMateAgain, slam::Origin{7, 1}})
      peers.hear(mate, static_cast<std::uint32_t>(i), {}, at(0.05 * i));
  }
  EXPECT_TRUE(peers.is_double(kMate.robot, kSelf, {}, at(2.0)));
  EXPECT_FALSE(peers.is_double(7, kSelf, {}, at(2.0)));
  EXPECT_FALSE(peers.is_double(99, kSelf, {}, at(2.0)));
  EXPECT_FALSE(peers.is_double(kMate.robot, kSelf, {}, at(9.0))) << "both are gone";
  peers.hear({kSelf.robot, 5}, 0, {}, at(9.0));
  EXPECT_FALSE(peers.is_double(kSelf.robot, kSelf, {}, at(9.0))) << "perhaps of an earlier run";
  peers.hear({kSelf.robot, 5}, 1, {}, at(10.5));
  EXPECT_TRUE(peers.is_double(kSelf.robot, kSelf, {}, at(10.5)));
}

TEST(Peers, AnotherWithThisRobotsIdIsADuplicate) {
  Peers peers;
  peers.hear({kSelf.robot, 5}, 0, {}, at(0.0));
  EXPECT_TRUE(peers.duplicates(kSelf, {}, at(0.1)).empty()) << "perhaps of an earlier run";
  peers.hear({kSelf.robot, 5}, 1, {}, at(1.5));
  const auto found = peers.duplicates(kSelf, {}, at(1.5));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].own);
  EXPECT_EQ(found[0].run_b, 5U);
}

TEST(Peers, ARobotIsListedOnceByItsNewestRun) {
  const slam::Origin other{7, 3};
  for (const auto& [before, after] : {std::pair(kMate, kMateAgain), std::pair(kMateAgain, kMate)}) {
    Peers peers;
    for (int i = 0; i < 100; ++i) peers.hear(before, static_cast<std::uint32_t>(i), {}, at(0.05 * i));
    peers.hear(other, 0, {}, at(1.0));
    EXPECT_EQ(peers.listed(kSelf, {}, at(5.0)), (std::vector{before, other}));
    for (int i = 0; i < 100; ++i) peers.hear(after, static_cast<std::uint32_t>(i), {}, at(5.0 + 0.05 * i));
    for (const double t : {5.0, 6.0, 8.0, 10.0, 300.0})
      EXPECT_EQ(peers.listed(kSelf, {}, at(t)), (std::vector{after, other})) << t << ": runs have no order";
    EXPECT_TRUE(peers.listed(kSelf, {}, at(700.0)).empty()) << "forgotten";
  }
}

TEST(Peers, BothOfTwoWithOneIdAreListed) {
  Peers peers;
  const slam::Origin own_id{kSelf.robot, 5};
  for (int i = 0; i < 40; ++i) {
    for (const slam::Origin& mate : {kMate, kMateAgain, own_id})
      peers.hear(mate, static_cast<std::uint32_t>(i), {}, at(0.05 * i));
  }
  EXPECT_EQ(peers.listed(kSelf, {}, at(2.0)), (std::vector{own_id, kMate, kMateAgain}));
  for (int i = 0; i < 100; ++i) peers.hear(kMate, static_cast<std::uint32_t>(40 + i), {}, at(2.0 + 0.05 * i));
  EXPECT_EQ(peers.listed(kSelf, {}, at(7.0)), std::vector{kMate}) << "the others are gone";
}

TEST(Peers, TheNewestMessageOfAKindCounts) {
  std::optional<std::uint32_t> newest;
  EXPECT_TRUE(is_newer(newest, 4));
  EXPECT_FALSE(is_newer(newest, 4));
  EXPECT_FALSE(is_newer(newest, 3));
  EXPECT_TRUE(is_newer(newest, 5));
}

}  // namespace
}  // namespace topo::team

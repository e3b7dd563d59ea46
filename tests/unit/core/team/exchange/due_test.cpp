// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/due.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::at;
using testing::kFrames;
using testing::kSelf;

const StreamKey kRelations{ItemKind::kRelation, kSelf};

ItemStore store_of(std::uint32_t keyframes) {
  ItemStore store;
  for (std::uint32_t i = 0; i < keyframes; ++i) {
    store.insert({kFrames, i}, std::make_shared<const std::vector<std::byte>>(3'000));
    store.insert({kRelations, i}, testing::item_of({1, 2, 3}));
  }
  return store;
}

/// A mate that wants these, having heard all datagrams up to one.
Peer mate(std::vector<StreamWants> streams, std::uint32_t heard = 100) {
  Peer peer;
  peer.heard = peer.wanted = at(0.0);
  peer.wants = WantList{kSelf, heard, std::move(streams)};
  return peer;
}

TEST(Due, WhatIsWantedAndHeldOnce) {
  const Peer a = mate({{kFrames, 0, {{0, 2, kAllPieces}}}}), b = mate({{kFrames, 0, {{1, 4, kAllPieces}}}});
  const std::vector<const Peer*> mates{&a, &b};
  const Due due = find_due(mates, store_of(3), {}, {});
  ASSERT_EQ(due.keyframes.size(), 9U) << "three keyframes of three pieces";
  EXPECT_EQ(due.keyframes[0].wanters, 0b01U);
  EXPECT_EQ(due.keyframes[3].wanters, 0b11U);
  EXPECT_EQ(due.keyframes[8].wanters, 0b10U);
  EXPECT_EQ(due.bytes, 9'000U);
}

TEST(Due, OnlyThePiecesThatAreWanted) {
  const Peer a = mate({{kFrames, 0, {{0, 1, 0b101}}}, {kRelations, 0, {{1, 1, kAllPieces}}}});
  const std::vector<const Peer*> mates{&a};
  const Due due = find_due(mates, store_of(2), {}, {});
  ASSERT_EQ(due.keyframes.size(), 2U);
  EXPECT_EQ(due.keyframes[1].index, 2U);
  ASSERT_EQ(due.relations.size(), 1U);
  EXPECT_EQ(due.relations[0].key.number, 1U);
}

TEST(Due, WhatIsUnderWayIsNotSentAgain) {
  SentLately sent;
  sent.note({kFrames, 0}, 1, 101);  // after what the mate had heard
  sent.note({kFrames, 0}, 2, 99);   // before: it was lost
  const Peer a = mate({{kFrames, 0, {{0, 1, kAllPieces}}}}, 100);
  const std::vector<const Peer*> mates{&a};
  const Due due = find_due(mates, store_of(1), sent, {});
  ASSERT_EQ(due.keyframes.size(), 2U);
  EXPECT_EQ(due.keyframes[0].index, 0U);
  EXPECT_EQ(due.keyframes[1].index, 2U);
  EXPECT_EQ(due.wanted_bytes, 3'000U);
  EXPECT_EQ(due.bytes, 2'000U);
}

TEST(Due, AMateCanNameNoMoreThanTheCap) {
  CapParams caps;
  caps.wanted_items = 5;
  const Peer a = mate({{kRelations, 0, {{0, kNumbersMax, kAllPieces}}}});
  const std::vector<const Peer*> mates{&a};
  EXPECT_EQ(find_due(mates, store_of(20), {}, caps).relations.size(), 5U);
}

TEST(Due, OnlyLiveMatesThatAskThisRobotCount) {
  const PeriodParams periods;
  Peers peers;
  for (std::uint16_t robot = 2; robot <= 4; ++robot) {
    peers.hear({robot, 1}, 0, {}, at(0.0));
    *peers.find({robot, 1}) = mate({});
  }
  peers.find({3, 1})->wants->to = {7, 1};
  peers.find({4, 1})->wanted = at(-100.0);
  EXPECT_EQ(wanting(peers, kSelf, periods, at(0.0)).size(), 1U);
  EXPECT_TRUE(wanting(peers, kSelf, periods, at(60.0)).empty());
}

TEST(Due, WhatAMateHoldsIsReadFromItsWords) {
  Peer peer = mate({{kFrames, 10, {{4, 1, 0b010}, {7, 2, kAllPieces}}}});
  peer.holds[kFrames] = {kFrames, 3, 4, 30, {}};
  EXPECT_TRUE(holds_piece(peer, {kFrames, 4}, 0)) << "of this one another piece is wanted";
  EXPECT_FALSE(holds_piece(peer, {kFrames, 4}, 1));
  EXPECT_FALSE(holds_piece(peer, {kFrames, 8}, 0));
  EXPECT_TRUE(holds_piece(peer, {kFrames, 9}, 0)) << "not wanted, among those that are covered";
  EXPECT_FALSE(holds_piece(peer, {kFrames, 20}, 0)) << "nothing is known of it";
  EXPECT_TRUE(holds_piece(peer, {kFrames, 2}, 0));
}

TEST(SentLately, ForgetsTheOldest) {
  SentLately sent;
  for (std::uint32_t i = 0; i < 20'000; ++i) sent.note({kFrames, i}, 0, i);
  EXPECT_FALSE(sent.find({kFrames, 0}, 0));
  EXPECT_EQ(sent.find({kFrames, 19'999}, 0), 19'999U);
}

DuePiece piece(std::uint32_t number, std::uint32_t wanters, std::uint32_t holders) {
  return {{kFrames, number}, 0, wanters, holders, 1'000};
}

TEST(PieceQueue, GivesTheOldestOrTheNewest) {
  PieceQueue queue({piece(1, 1, 0), piece(2, 1, 0), piece(3, 1, 0)}, 1);
  EXPECT_EQ(queue.take(true).piece.key.number, 3U);
  EXPECT_EQ(queue.take(false).piece.key.number, 1U);
  EXPECT_EQ(queue.take(false).piece.key.number, 2U);
  EXPECT_TRUE(queue.empty());
}

TEST(PieceQueue, PairsWhatEachLostAndTheOtherHolds) {
  PieceQueue queue({piece(1, 0b01, 0b10), piece(2, 0b01, 0b10), piece(3, 0b10, 0b01)}, 2);
  const auto pick = queue.take(false);
  EXPECT_EQ(pick.piece.key.number, 1U);
  ASSERT_TRUE(pick.partner);
  EXPECT_EQ(pick.partner->key.number, 3U);
  EXPECT_EQ(queue.take(false).piece.key.number, 2U);
  EXPECT_TRUE(queue.empty());
}

TEST(PieceQueue, WhatNobodyIsKnownToHoldHasNoPartner) {
  PieceQueue queue({piece(1, 0b01, 0), piece(2, 0b10, 0b01)}, 2);
  EXPECT_FALSE(queue.take(false).partner);
}

TEST(PieceQueue, WhatAllWantGoesBeforeWhatWaitsForAPartner) {
  PieceQueue queue({piece(1, 0b01, 0b10), piece(2, 0b11, 0)}, 2);
  EXPECT_EQ(queue.take(false).piece.key.number, 2U);
  EXPECT_FALSE(queue.empty());
  EXPECT_EQ(queue.take(false).piece.key.number, 1U);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/wire.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

const DatagramHead kHead{0xA1B2C3D4U, {7, 9}, 0xFFFF'FFFFU};

Datagram two_messages() {
  DatagramWriter writer(kHead);
  writer.add(MessageKind::kLog, testing::bytes_of({1, 2, 3}));
  writer.add(MessageKind::kPiece, std::vector<std::byte>(300));
  return writer.take();
}

TEST(Wire, ADatagramIsReadAsItWasWritten) {
  const Datagram datagram = two_messages();
  DatagramHead head;
  ASSERT_EQ(read_head(datagram, head), HeadVerdict::kGood);
  EXPECT_EQ(head.team, kHead.team);
  EXPECT_EQ(head.sender, kHead.sender);
  EXPECT_EQ(head.counter, kHead.counter);
  MessageReader messages(datagram);
  const auto first = messages.next(), second = messages.next();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->kind, static_cast<std::uint8_t>(MessageKind::kLog));
  EXPECT_EQ(first->body.size(), 3U);
  EXPECT_EQ(second->body.size(), 300U);
  EXPECT_FALSE(messages.next());
  EXPECT_TRUE(messages.ok());
}

TEST(Wire, WhatIsCutOffIsMalformed) {
  const Datagram datagram = two_messages();
  DatagramHead head;
  for (std::size_t size = 0; size < kHeadBytes; ++size)
    EXPECT_EQ(read_head(std::span(datagram).first(size), head), HeadVerdict::kMalformed) << size;
  const auto cut = std::span(datagram).first(datagram.size() - 1);
  MessageReader messages(cut);
  EXPECT_TRUE(messages.next());
  EXPECT_FALSE(messages.next());
  EXPECT_FALSE(messages.ok());
}

TEST(Wire, AnotherVersionIsNamedAsSuch) {
  Datagram datagram = two_messages();
  datagram[1] = std::byte{kWireVersion + 1};
  DatagramHead head;
  EXPECT_EQ(read_head(datagram, head), HeadVerdict::kOtherVersion);
  datagram[0] = std::byte{'X'};
  EXPECT_EQ(read_head(datagram, head), HeadVerdict::kMalformed);
}

TEST(Wire, AWriterNeverExceedsADatagram) {
  DatagramWriter writer(kHead);
  EXPECT_TRUE(writer.fits(kBodyBytesMax));
  EXPECT_FALSE(writer.fits(kBodyBytesMax + 1));
  writer.add(MessageKind::kPiece, std::vector<std::byte>(kBodyBytesMax));
  EXPECT_EQ(writer.size(), kDatagramBytesMax);
  EXPECT_FALSE(writer.fits(0));
}

TEST(Wire, CountersWrapAround) {
  EXPECT_TRUE(is_later(2, 0xFFFF'FFF0U));
  EXPECT_FALSE(is_later(0xFFFF'FFF0U, 2));
  EXPECT_FALSE(is_later(5, 5));
}

TEST(Wire, KeysAreReadAsWrittenAndNumbersBounded) {
  const ItemKey key{{ItemKind::kRelation, {65'535, 0xFFFF'FFFFU}}, kNumbersMax - 1};
  types::ByteWriter out;
  write_key(out, key);
  types::ByteReader in(out.bytes());
  bool ok = true;
  EXPECT_EQ(read_key(in, ok), key);
  EXPECT_TRUE(ok && in.complete());
  types::ByteWriter beyond;
  write_key(beyond, {key.stream, kNumbersMax});
  types::ByteReader hostile(beyond.bytes());
  (void)read_key(hostile, ok);
  EXPECT_FALSE(ok);
}

TEST(Wire, NamesOfTeamsDiffer) { EXPECT_NE(team_hash("north"), team_hash("south")); }

TEST(Wire, EveryKindHasItsName) {
  std::set<std::string_view> names;
  for (std::size_t kind = 0; kind < kMessageKinds; ++kind)
    names.insert(to_text(static_cast<MessageKind>(kind)));
  EXPECT_EQ(names.size(), kMessageKinds);
  EXPECT_FALSE(names.contains("unknown"));
}

}  // namespace
}  // namespace topo::team

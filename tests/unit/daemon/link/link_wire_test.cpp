// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/link_wire.hpp"

#include <gmock/gmock.h>

#include <set>

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const LinkIdentity kSelf{.team = team_hash("office"), .robot = 7, .version = kLinkVersion};

LinkStats some_stats() {
  LinkStats stats;
  stats.radio = true;
  stats.mates = 3;
  stats.sent = 1;
  stats.received = 2;
  stats.sent_bytes = 1ULL << 40U;
  stats.received_bytes = 4;
  for (std::size_t i = 0; i < kLinkDrops; ++i) stats.dropped[i] = 10 + i;
  return stats;
}

TEST(LinkWire, GreetingIsReadBack) {
  const auto read = decode_hello(encode_hello(kSelf));
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(*read, kSelf);
}

TEST(LinkWire, GreetingCutOrOfAnotherIsNone) {
  auto packet = encode_hello(kSelf);
  for (std::size_t n = 0; n < packet.size(); ++n)
    EXPECT_FALSE(decode_hello(std::span(packet).first(n)).has_value()) << n;
  auto longer = packet;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode_hello(longer).has_value());
  auto stranger = packet;
  stranger[1] = std::byte{'X'};
  EXPECT_FALSE(decode_hello(stranger).has_value());
}

TEST(LinkWire, GreetingOfAnotherVersionTellsIt) {
  LinkIdentity newer = kSelf;
  newer.version = kLinkVersion + 1;
  auto packet = encode_hello(newer);
  packet.resize(packet.size() + 30);  // what a later version may add
  const auto read = decode_hello(packet);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->version, kLinkVersion + 1);
  EXPECT_THAT(mismatch(kSelf, *read), HasSubstr("found version " + std::to_string(kLinkVersion + 1) + " "));
}

TEST(LinkWire, StatisticsAreReadBack) {
  const auto packet = encode_stats(some_stats());
  const auto read = decode_stats(packet);
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(*read, some_stats());
  EXPECT_EQ(read->dropped_by(LinkDrop::kFalseNumber), 10 + kLinkDrops - 1);
  for (std::size_t n = 0; n < packet.size(); ++n)
    EXPECT_FALSE(decode_stats(std::span(packet).first(n)).has_value()) << n;
}

TEST(LinkWire, RefusalIsPrintableAndBounded) {
  EXPECT_EQ(decode_refusal(encode_refusal("no: \x1b[2J")), "no: ?[2J");
  EXPECT_EQ(decode_refusal(encode_refusal(std::string(5000, 'x'))).size(), 512U);
  EXPECT_EQ(decode_refusal(encode_hello(kSelf)), "");
}

TEST(LinkWire, WhatDoesNotFitIsNamed) {
  EXPECT_THAT(mismatch(kSelf, kSelf), IsEmpty());
  LinkIdentity other = kSelf;
  other.robot = 8;
  EXPECT_THAT(mismatch(kSelf, other), HasSubstr("found robot 8 at the other end, expected 7"));
  other.team = team_hash("Office");
  EXPECT_THAT(mismatch(kSelf, other), HasSubstr("another team's name"));
}

TEST(LinkWire, HashIsFnv1a) {
  EXPECT_EQ(team_hash(""), 0xCBF29CE484222325U);
  EXPECT_EQ(team_hash("a"), 0xAF63DC4C8601EC8CU);
}

TEST(LinkWire, EveryDropHasAName) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kLinkDrops; ++i) names.insert(drop_name(static_cast<LinkDrop>(i)));
  EXPECT_EQ(names.size(), kLinkDrops);
  EXPECT_FALSE(names.contains("unknown"));
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/neighbours.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace topo::io {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr const char* kTable =
    "IP address       HW type     Flags       HW address            Mask     Device\n"
    "192.168.0.10     0x1         0x2         00:1d:48:00:00:01     *        eth0\n"
    "192.168.0.11     0x1         0x0         00:00:00:00:00:00     *        eth0\n"
    "192.168.0.10     0x1         0x6         00:1d:48:00:00:02     *        eth1\n";

TEST(Neighbours, OnlyCompleteEntriesCount) {
  EXPECT_THAT(parse_neighbour_table(kTable),
              ElementsAre(Neighbour{"192.168.0.10", "00:1d:48:00:00:01", "eth0"},
                          Neighbour{"192.168.0.10", "00:1d:48:00:00:02", "eth1"}));
}

TEST(Neighbours, WhatIsNoTableHasNone) {
  for (const char* text : {"", "one line", "a\nb c\n\n192.168.0.10 0x1\n"})
    EXPECT_THAT(parse_neighbour_table(text), IsEmpty()) << text;
}

/// A reply of 192.168.0.10 (RFC 826).
std::vector<std::uint8_t> reply() {
  return {0,   1,   8, 0,  6, 4, 0, 2, 0x00, 0x1d, 0x48, 0,   0, 1,
          192, 168, 0, 10, 2, 2, 2, 2, 2,    2,    192,  168, 0, 1};
}

TEST(ArpSender, IsReadFromAReplyForTheAddress) {
  EXPECT_EQ(arp_sender(reply(), "192.168.0.10"), "00:1d:48:00:00:01");
  auto padded = reply();
  padded.resize(46);
  EXPECT_EQ(arp_sender(padded, "192.168.0.10"), "00:1d:48:00:00:01");
}

TEST(ArpSender, NothingElseIsTakenForOne) {
  EXPECT_EQ(arp_sender(reply(), "192.168.0.11"), std::nullopt);
  for (std::size_t size = 0; size < reply().size(); ++size) {
    auto cut = reply();
    cut.resize(size);
    EXPECT_EQ(arp_sender(cut, "192.168.0.10"), std::nullopt) << size;
  }
  for (std::size_t i = 0; i < 8; ++i) {
    auto other = reply();
    other[i] ^= 0x5;
    EXPECT_EQ(arp_sender(other, "192.168.0.10"), std::nullopt) << i;
  }
}

TEST(AskNeighbours, WantsAnIpv4Address) {
  const auto asked = ask_neighbours("scanner.example", std::chrono::milliseconds(1));
  ASSERT_FALSE(asked);
  EXPECT_EQ(asked.error().code, types::Errc::kInvalidInput);
}

}  // namespace
}  // namespace topo::io

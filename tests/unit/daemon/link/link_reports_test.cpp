// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "daemon/link/dds_log.hpp"
#include "daemon/link/drop_log.hpp"
#include "daemon/link/link_loop.hpp"
#include "daemon/link/network_watch.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

LinkStats with(std::uint64_t other_team, std::uint64_t repeated) {
  LinkStats stats;
  stats.dropped[static_cast<std::size_t>(LinkDrop::kOtherTeam)] = other_team;
  stats.dropped[static_cast<std::size_t>(LinkDrop::kRepeated)] = repeated;
  return stats;
}

TEST(DropLog, OneLineAMinuteByKind) {
  DropLog log;
  types::Stamp now = types::stamp_from_seconds(50.0);
  EXPECT_FALSE(log.line(now, with(5, 0)).has_value()) << "what was before is not of this minute";
  int lines = 0;
  std::string last;
  for (std::uint64_t s = 1; s <= 120; ++s) {
    if (const auto line = log.line(now += 1s, with(5 + s, s >= 60 ? 2 : 0))) {
      ++lines;
      last = *line;
    }
  }
  EXPECT_EQ(lines, 2);
  EXPECT_EQ(last, "dropped in the last minute: 60 another team");
}

TEST(DropLog, SilentWhenNothingIsDropped) {
  DropLog log;
  types::Stamp now{};
  for (int s = 0; s < 300; ++s) EXPECT_FALSE(log.line(now += 1s, with(1, 1)).has_value());
}

TEST(LineLimit, FewAPeriodAndTheRestCounted) {
  LineLimit limit({.lines = 2, .period = 60s});
  types::Stamp now = types::stamp_from_seconds(1000.0);
  EXPECT_EQ(limit.pass(now, "a"), "a");
  EXPECT_EQ(limit.pass(now + 1s, "b"), "b");
  EXPECT_FALSE(limit.pass(now + 2s, "c").has_value());
  EXPECT_FALSE(limit.pass(now + 59s, "d").has_value());
  EXPECT_EQ(limit.pass(now + 60s, "e"), "e (2 lines left out before)");
  EXPECT_EQ(limit.pass(now + 61s, "f"), "f");
}

TEST(Refusal, IsToldFromOtherLines) {
  EXPECT_TRUE(is_refusal(
      "Begin handshake reply failed: Certificate not valid: error: certificate signature failure"));
  EXPECT_TRUE(is_refusal("Access control does not allow remote writer 110a2f:1:1:103"));
  EXPECT_FALSE(is_refusal("ddsi_udp_conn_write to udp/239.255.0.1:7650 failed with retcode -1"));
  EXPECT_FALSE(is_refusal(""));
}

TEST(Carried, IsReadBack) {
  Carried carried;
  carried.daemon_fd = 12;
  carried.stats = with(3, 0xFFFF'FFFF'FFFFU);
  const Carried read = parse_carried(carried_text(carried));
  EXPECT_EQ(read.daemon_fd, 12);
  EXPECT_EQ(read.stats, carried.stats);
  EXPECT_FALSE(read.quiet);
  carried.quiet = true;
  EXPECT_TRUE(parse_carried(carried_text(carried)).quiet);
  EXPECT_EQ(parse_carried(carried_text(carried)).daemon_fd, 12);
}

TEST(Carried, AnUnreadableTextCarriesNothing) {
  const std::string whole = carried_text({.daemon_fd = 12, .stats = with(3, 4), .quiet = false});
  for (const std::string& text : {std::string(), std::string("x"), std::string("12:"), std::string("12:03zz"),
                                  whole.substr(0, whole.size() - 1), "x" + whole}) {
    const Carried read = parse_carried(text);
    EXPECT_EQ(read.daemon_fd, -1) << text;
    EXPECT_EQ(read.stats, LinkStats{}) << text;
  }
}

TEST(NetworkAddress, OfTheLoopbackAndOfNone) {
  const auto loopback = network_address("lo");
  if (!loopback) GTEST_SKIP() << "the loopback is not up here";
  EXPECT_EQ(loopback->address, "127.0.0.1");
  EXPECT_FALSE(loopback->multicast);
  EXPECT_GT(loopback->index, 0U);
  EXPECT_FALSE(network_address("no-such-radio").has_value());
}

}  // namespace
}  // namespace topo::daemon

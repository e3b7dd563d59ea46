// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/link/link_socket.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/socket.h>

#include <filesystem>

#include "daemon/link/daemon_line.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Kind = LinkNews::Kind;

const LinkIdentity kOwn{.team = team_hash("office"), .robot = 7, .version = kLinkVersion};

std::vector<std::byte> bytes(std::string_view text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

/// Both ends of one socket, and a clock that only the test moves.
class LinkSocketTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto listening = LinkSocket::listen(path, kOwn);
    ASSERT_TRUE(listening.has_value()) << listening.error().message;
    daemon.emplace(std::move(*listening));
  }

  std::optional<LinkNews> daemon_turn() {
    auto news = daemon->turn(now, [this](std::uint16_t sender, std::span<const std::byte> datagram) {
      senders.push_back(sender);
      at_daemon.emplace_back(reinterpret_cast<const char*>(datagram.data()), datagram.size());
    });
    if (news) told.push_back(*news);
    return news;
  }
  std::optional<std::string> link_turn(DaemonLine& line) {
    return line.turn(
        now,
        [this](std::span<const std::byte> datagram) {
          at_link.emplace_back(reinterpret_cast<const char*>(datagram.data()), datagram.size());
        },
        wrong_size);
  }
  /// As many turns as the greetings take.
  void greet(DaemonLine& line) {
    for (int i = 0; i < 3; ++i) {
      static_cast<void>(link_turn(line));
      static_cast<void>(daemon_turn());
    }
    ASSERT_TRUE(line.joined());
    ASSERT_TRUE(daemon->joined());
  }
  [[nodiscard]] std::vector<Kind> kinds() const {
    std::vector<Kind> out;
    for (const auto& news : told) out.push_back(news.kind);
    return out;
  }

  testing::TempDir folder;
  std::string path = folder.file("link.sock");
  std::optional<LinkSocket> daemon;
  types::Stamp now = types::stamp_from_seconds(1000.0);
  std::vector<LinkNews> told;
  std::vector<std::string> at_daemon, at_link;
  std::vector<std::uint16_t> senders;
  std::uint64_t wrong_size = 0;
};

TEST_F(LinkSocketTest, DatagramsFlowBothWays) {
  DaemonLine line(path, kOwn);
  greet(line);
  EXPECT_TRUE(daemon->send(bytes("out")));
  EXPECT_TRUE(daemon->send(bytes("more")));
  EXPECT_EQ(line.send(3, bytes("in")), LinkChannel::Sent::kYes);
  static_cast<void>(link_turn(line));
  static_cast<void>(daemon_turn());
  EXPECT_THAT(at_link, ElementsAre("out", "more"));
  EXPECT_THAT(at_daemon, ElementsAre("in"));
  EXPECT_THAT(senders, ElementsAre(3));
  EXPECT_EQ(daemon->counts().sent, 2U);
  EXPECT_EQ(daemon->counts().received, 1U);
  EXPECT_THAT(kinds(), ElementsAre(Kind::kJoined));
}

TEST_F(LinkSocketTest, OnlyTheOwnerCanConnect) {
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms{0600});
}

TEST_F(LinkSocketTest, SizesOutsideAreDroppedAndCounted) {
  DaemonLine line(path, kOwn);
  greet(line);
  EXPECT_TRUE(daemon->send(std::vector<std::byte>(kDatagramMax_bytes)));
  EXPECT_FALSE(daemon->send(std::vector<std::byte>(kDatagramMax_bytes + 1)));
  EXPECT_FALSE(daemon->send({}));
  EXPECT_EQ(daemon->counts().dropped_size, 2U);
  static_cast<void>(link_turn(line));
  ASSERT_EQ(at_link.size(), 1U);
  EXPECT_EQ(at_link[0].size(), kDatagramMax_bytes);
}

TEST_F(LinkSocketTest, WithoutALinkAloneIsToldOnce) {
  for (int i = 0; i < 10; ++i, now += 1s) {
    static_cast<void>(daemon_turn());
    EXPECT_FALSE(daemon->send(bytes("x")));
  }
  ASSERT_THAT(kinds(), ElementsAre(Kind::kAlone));
  EXPECT_THAT(told[0].words, HasSubstr("no link is there"));
  EXPECT_EQ(daemon->counts().dropped_alone, 10U);
}

TEST_F(LinkSocketTest, LinkThatDiesIsToldOnceAndComesBack) {
  {
    DaemonLine line(path, kOwn);
    greet(line);
  }
  for (int i = 0; i < 10; ++i, now += 1s) static_cast<void>(daemon_turn());
  EXPECT_THAT(kinds(), ElementsAre(Kind::kJoined, Kind::kAlone));
  EXPECT_FALSE(daemon->send(bytes("x")));
  DaemonLine again(path, kOwn);
  greet(again);
  EXPECT_THAT(kinds(), ElementsAre(Kind::kJoined, Kind::kAlone, Kind::kJoined));
}

TEST_F(LinkSocketTest, StoppedLinkIsAloneAndHeardAgain) {
  DaemonLine line(path, kOwn);
  greet(line);
  for (int i = 0; i < 5; ++i, now += 1s) static_cast<void>(daemon_turn());
  EXPECT_THAT(kinds(), ElementsAre(Kind::kJoined, Kind::kAlone));
  EXPECT_THAT(told[1].words, HasSubstr("says nothing for 3 s"));
  EXPECT_FALSE(daemon->send(bytes("x")));
  line.send_stats({});
  static_cast<void>(daemon_turn());
  EXPECT_THAT(kinds(), ElementsAre(Kind::kJoined, Kind::kAlone, Kind::kJoined));
}

TEST_F(LinkSocketTest, FullIsDroppedAndNeverWaits) {
  DaemonLine line(path, kOwn);
  greet(line);
  const std::vector<std::byte> datagram(kDatagramMax_bytes);
  std::uint64_t sent = 0;
  for (int i = 0; i < 10'000; ++i) sent += daemon->send(datagram) ? 1U : 0U;
  EXPECT_GT(sent, 10U);
  EXPECT_GT(daemon->counts().dropped_full, 0U);
  EXPECT_EQ(sent + daemon->counts().dropped_full, 10'000U);
  // Room again when the link takes them.
  for (int i = 0; i < 20; ++i) static_cast<void>(link_turn(line));
  EXPECT_EQ(at_link.size(), sent);
  EXPECT_TRUE(daemon->send(datagram));
}

TEST_F(LinkSocketTest, AnotherTeamIsRefusedWithWordsOnce) {
  DaemonLine line(path, {.team = team_hash("other"), .robot = 7, .version = kLinkVersion});
  std::vector<std::string> words;
  for (int i = 0; i < 12; ++i, now += 500ms) {
    if (const auto said = link_turn(line)) words.push_back(*said);
    static_cast<void>(daemon_turn());
  }
  ASSERT_THAT(kinds(), ElementsAre(Kind::kRefused));
  EXPECT_THAT(told[0].words, HasSubstr("another team's name"));
  ASSERT_THAT(words, ElementsAre(HasSubstr("do not fit: ")));
  EXPECT_FALSE(daemon->joined());
  EXPECT_FALSE(line.joined());
}

TEST_F(LinkSocketTest, AnotherVersionIsRefusedByBoth) {
  DaemonLine line(path, {.team = kOwn.team, .robot = 7, .version = kLinkVersion + 1});
  static_cast<void>(link_turn(line));
  static_cast<void>(daemon_turn());
  ASSERT_THAT(kinds(), ElementsAre(Kind::kRefused));
  EXPECT_THAT(told[0].words, HasSubstr(fmt::format("found version {}", kLinkVersion + 1)));
  const auto said = link_turn(line);
  ASSERT_TRUE(said.has_value());
  EXPECT_THAT(*said, HasSubstr("do not fit"));
}

TEST_F(LinkSocketTest, WhoDoesNotGreetIsRefused) {
  const auto stranger = io::connect_unix(path, 1s, kLinkSocketKind);
  ASSERT_TRUE(stranger.has_value());
  ASSERT_EQ(::send(stranger->get(), "hello", 5, 0), 5);
  static_cast<void>(daemon_turn());
  static_cast<void>(daemon_turn());
  ASSERT_THAT(kinds(), ElementsAre(Kind::kRefused));
  EXPECT_THAT(told[0].words, HasSubstr("found no greeting"));
}

TEST_F(LinkSocketTest, ASecondLinkIsRefusedWhileTheFirstLives) {
  DaemonLine first(path, kOwn), second(path, kOwn);
  greet(first);
  static_cast<void>(link_turn(second));
  static_cast<void>(daemon_turn());
  const auto said = link_turn(second);
  ASSERT_TRUE(said.has_value());
  EXPECT_THAT(*said, HasSubstr("another link serves this daemon"));
  EXPECT_TRUE(daemon->send(bytes("x")));
  static_cast<void>(link_turn(first));
  EXPECT_THAT(at_link, ElementsAre("x"));
}

TEST_F(LinkSocketTest, ASecondLinkReplacesAStoppedOne) {
  DaemonLine stopped(path, kOwn);
  greet(stopped);
  now += 4s;
  DaemonLine second(path, kOwn);
  greet(second);
  EXPECT_TRUE(daemon->send(bytes("x")));
  static_cast<void>(link_turn(second));
  EXPECT_THAT(at_link, ElementsAre("x"));
}

TEST_F(LinkSocketTest, StatisticsAreKept) {
  DaemonLine line(path, kOwn);
  greet(line);
  EXPECT_FALSE(daemon->link().has_value());
  LinkStats stats;
  stats.sent = 5;
  line.send_stats(stats);
  static_cast<void>(daemon_turn());
  ASSERT_TRUE(daemon->link().has_value());
  EXPECT_EQ(daemon->link()->sent, 5U);
}

TEST_F(LinkSocketTest, UnknownMessagesAreCounted) {
  auto socket = io::connect_unix(path, 1s, kLinkSocketKind);
  ASSERT_TRUE(socket.has_value());
  LinkChannel channel(std::move(*socket), kOwn);
  const std::byte odd{99};
  channel.send({&odd, 1});
  channel.send(std::vector<std::byte>(3, std::byte{5}));  // a datagram without content
  channel.send(std::vector<std::byte>(kDatagramMax_bytes + 4, std::byte{5}));
  channel.send(std::vector<std::byte>(9, std::byte{2}));  // whose sender is not told
  static_cast<void>(daemon_turn());
  EXPECT_EQ(daemon->counts().malformed, 4U);
  EXPECT_THAT(at_daemon, IsEmpty());
  EXPECT_TRUE(daemon->joined());
}

TEST_F(LinkSocketTest, TooLongAMessageEndsTheConnection) {
  auto socket = io::connect_unix(path, 1s, kLinkSocketKind);
  ASSERT_TRUE(socket.has_value());
  LinkChannel channel(std::move(*socket), kOwn);
  channel.send(std::vector<std::byte>(5000, std::byte{5}));
  static_cast<void>(daemon_turn());
  static_cast<void>(daemon_turn());
  ASSERT_FALSE(told.empty());
  EXPECT_THAT(told.back().words, HasSubstr("found a message of 5000 bytes"));
}

TEST_F(LinkSocketTest, BeginningAnewKeepsTheConnection) {
  DaemonLine line(path, kOwn);
  greet(line);
  DaemonLine anew(path, kOwn, ::dup(line.fd()));
  EXPECT_TRUE(anew.joined());
  EXPECT_TRUE(daemon->send(bytes("x")));
  EXPECT_FALSE(link_turn(anew).has_value());
  EXPECT_THAT(at_link, ElementsAre("x"));
}

TEST_F(LinkSocketTest, ALinkWaitsForADaemon) {
  daemon.reset();
  DaemonLine line(path, kOwn);
  const auto said = link_turn(line);
  ASSERT_TRUE(said.has_value());
  EXPECT_THAT(*said, HasSubstr("waiting for the daemon: link socket "));
  now += 5s;
  EXPECT_FALSE(link_turn(line).has_value()) << "the same words once";
  SetUp();
  now += 1s;
  greet(line);
}

TEST_F(LinkSocketTest, TheDescriptorIsReadableWhenThereIsNews) {
  pollfd entry{daemon->fd(), POLLIN, 0};
  EXPECT_EQ(::poll(&entry, 1, 0), 0);
  DaemonLine line(path, kOwn);
  static_cast<void>(link_turn(line));
  EXPECT_EQ(::poll(&entry, 1, 0), 1);
  greet(line);
  EXPECT_EQ(::poll(&entry, 1, 0), 0);
  line.send(2, bytes("x"));
  EXPECT_EQ(::poll(&entry, 1, 0), 1);
}

TEST_F(LinkSocketTest, AnotherDaemonOnThePathIsRefused) {
  const auto second = LinkSocket::listen(path, kOwn);
  ASSERT_FALSE(second.has_value());
  EXPECT_THAT(second.error().message, HasSubstr("link socket "));
}

}  // namespace
}  // namespace topo::daemon

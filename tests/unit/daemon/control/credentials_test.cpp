// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/credentials.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

namespace topo::daemon {
namespace {

constexpr uid_t kDaemon = 990;
constexpr gid_t kGroup = 991;

TEST(MayCommand, RootOwnUserAndGroupOnly) {
  EXPECT_TRUE(may_command({0, 0, 1, {}}, kDaemon, kGroup));
  EXPECT_TRUE(may_command({kDaemon, 5, 1, {}}, kDaemon, kGroup));
  EXPECT_TRUE(may_command({1000, kGroup, 1, {}}, kDaemon, kGroup));
  EXPECT_TRUE(may_command({1000, 1000, 1, {24, kGroup, 27}}, kDaemon, kGroup));
  EXPECT_FALSE(may_command({1000, 1000, 1, {24, 27}}, kDaemon, kGroup));
  EXPECT_FALSE(may_command({1000, 1000, 1, {}}, kDaemon, kGroup));
}

TEST(MayCommand, WithoutTheGroupOnlyRootAndOwnUser) {
  EXPECT_TRUE(may_command({0, 0, 1, {}}, kDaemon, {}));
  EXPECT_TRUE(may_command({kDaemon, 1, 1, {}}, kDaemon, {}));
  EXPECT_FALSE(may_command({1000, 1000, 1, {1000}}, kDaemon, {}));
}

TEST(MayCommand, UnknownPeerMayNot) { EXPECT_FALSE(may_command(Peer{}, kDaemon, kGroup)); }

TEST(PeerOf, IsWhoMadeTheSocket) {
  int pair[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair), 0);
  const auto peer = peer_of(pair[0]);
  ASSERT_TRUE(peer.has_value());
  EXPECT_EQ(peer->uid, ::geteuid());
  EXPECT_EQ(peer->gid, ::getegid());
  EXPECT_EQ(peer->pid, ::getpid());
  ::close(pair[0]);
  ::close(pair[1]);
  EXPECT_FALSE(peer_of(-1).has_value());
}

TEST(FindGroup, ByName) {
  EXPECT_EQ(find_group("root"), gid_t{0});
  EXPECT_FALSE(find_group("no-such-group-here").has_value());
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/probe.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>
#include <vector>

#include "drivers/io/posix.hpp"
#include "drivers/io/unix_socket.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

class ProbeTest : public ::testing::Test {
 protected:
  testing::TempDir folder;
  std::string path = folder.file("s");
};

TEST_F(ProbeTest, NobodyIsThere) {
  EXPECT_EQ(probe(path, 50ms).served, Served::kNobody);
  (void)folder.write("s", "no socket");
  EXPECT_EQ(probe(path, 50ms).served, Served::kNobody);
}

TEST_F(ProbeTest, AnAnswerIsLife) {
  const auto listening = io::ListeningSocket::open(path);
  ASSERT_TRUE(listening) << listening.error().message;
  std::thread daemon([&] {
    if (io::wait_for(listening->fd(), POLLIN, 20s) <= 0) return;
    const io::UniqueFd client(::accept(listening->fd(), nullptr, nullptr));
    if (io::wait_for(client.get(), POLLIN, 20s) > 0) (void)::send(client.get(), "{}\n", 3, MSG_NOSIGNAL);
  });
  EXPECT_EQ(probe(path, 20s).served, Served::kByLiving);
  daemon.join();
}

// The kernel takes clients up for a daemon that hangs, until there are too many of them.
TEST_F(ProbeTest, SilenceIsNone) {
  const auto listening = io::ListeningSocket::open(path);
  ASSERT_TRUE(listening) << listening.error().message;
  EXPECT_EQ(probe(path, 50ms).served, Served::kByHung);
  EXPECT_EQ(probe(path, 50ms).pid, ::getpid());
  std::vector<io::UniqueFd> crowd;
  auto client = io::connect_unix(path, 50ms);
  for (; client && crowd.size() < 1000; client = io::connect_unix(path, 50ms))
    crowd.push_back(std::move(*client));
  ASSERT_FALSE(client) << "no limit";
  EXPECT_EQ(client.error().code, types::Errc::kTimeout);
  EXPECT_EQ(probe(path, 50ms).served, Served::kByHung);
}

}  // namespace
}  // namespace topo::daemon

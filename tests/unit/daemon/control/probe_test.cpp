// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/probe.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <thread>
#include <vector>

#include "drivers/io/posix.hpp"
#include "drivers/io/unix_socket.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

/// A process that serves a socket and takes nobody up.
class Stuck {
 public:
  explicit Stuck(const std::string& path) {
    int ready[2] = {};
    if (::pipe(ready) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
      const auto listening = io::ListeningSocket::open(path);
      (void)::write(ready[1], listening ? "y" : "n", 1);
      for (;;) ::pause();
    }
    char word = 0;
    serves_ = ::read(ready[0], &word, 1) == 1 && word == 'y';
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Stuck() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Stuck(const Stuck&) = delete;
  Stuck& operator=(const Stuck&) = delete;
  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] bool serves() const { return serves_; }

 private:
  pid_t pid_ = -1;
  bool serves_ = false;
};

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
  const Stuck daemon(path);
  ASSERT_TRUE(daemon.serves());
  EXPECT_EQ(probe(path, 50ms).served, Served::kByHung);
  EXPECT_EQ(probe(path, 50ms).pid, daemon.pid());
  std::vector<io::UniqueFd> crowd;
  auto client = io::connect_unix(path, 50ms);
  for (; client && crowd.size() < 1000; client = io::connect_unix(path, 50ms))
    crowd.push_back(std::move(*client));
  ASSERT_FALSE(client) << "no limit";
  EXPECT_EQ(client.error().code, types::Errc::kTimeout);
  EXPECT_EQ(probe(path, 50ms).served, Served::kByHung);
  EXPECT_EQ(probe(path, 50ms).pid, daemon.pid()) << "so that it can be ended";
}

TEST_F(ProbeTest, WhoHangsUpDoesNotHang) {
  const auto listening = io::ListeningSocket::open(path);
  ASSERT_TRUE(listening) << listening.error().message;
  std::atomic<bool> done = false;
  std::thread daemon([&] {
    while (!done) {
      if (io::wait_for(listening->fd(), POLLIN, 1ms) > 0)
        const io::UniqueFd client(::accept(listening->fd(), nullptr, nullptr));
    }
  });
  EXPECT_EQ(probe(path, 300ms).served, Served::kByLiving);
  done = true;
  daemon.join();
}

TEST_F(ProbeTest, WhoEndsWhileItIsAskedIsNobody) {
  auto listening = io::ListeningSocket::open(path);
  ASSERT_TRUE(listening) << listening.error().message;
  std::thread daemon([served = std::move(*listening)]() mutable {
    (void)io::wait_for(served.fd(), POLLIN, 20s);
    const io::UniqueFd client(::accept(served.fd(), nullptr, nullptr));
    const io::ListeningSocket ended(std::move(served));
  });
  EXPECT_EQ(probe(path, 20s).served, Served::kNobody);
  daemon.join();
}

}  // namespace
}  // namespace topo::daemon

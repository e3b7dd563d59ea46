// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/unix_socket.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <thread>
#include <vector>

#include "drivers/io/posix.hpp"

namespace topo::io {
namespace {

using ::testing::HasSubstr;
using types::Errc;
using namespace std::chrono_literals;

/// A signal to this thread every 2 ms, that interrupts what it waits in.
class Interruptions {
 public:
  Interruptions() {
    count = 0;
    struct sigaction action {};
    action.sa_handler = [](int) { ++count; };
    ::sigaction(SIGALRM, &action, &before_);
    every(2ms);
  }
  ~Interruptions() {
    every(0ms);
    ::sigaction(SIGALRM, &before_, nullptr);
  }
  Interruptions(const Interruptions&) = delete;
  Interruptions& operator=(const Interruptions&) = delete;

  static inline std::atomic<int> count = 0;

 private:
  static void every(std::chrono::microseconds period) {
    const itimerval timer{{0, period.count()}, {0, period.count()}};
    ::setitimer(ITIMER_REAL, &timer, nullptr);
  }
  struct sigaction before_ {};
};

class UnixSocketTest : public ::testing::Test {
 protected:
  daemon::testing::TempDir folder;
  /// As many clients as the kernel takes up for a daemon that takes up none.
  std::vector<UniqueFd> crowd() const {
    std::vector<UniqueFd> clients;
    for (auto client = connect_unix(path, 1ms); client && clients.size() < 1000;
         client = connect_unix(path, 1ms))
      clients.push_back(std::move(*client));
    return clients;
  }

  std::string path = folder.file("s");
};

TEST_F(UnixSocketTest, TakesClientsAndLeavesNothing) {
  {
    const auto listening = ListeningSocket::open(path);
    ASSERT_TRUE(listening.has_value()) << listening.error().message;
    EXPECT_TRUE(connect_unix(path).has_value());
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_EQ(connect_unix(path).error().code, Errc::kNotFound);
}

/// Whoever may read the lock file can lock it, and no daemon would start any more.
TEST_F(UnixSocketTest, LockFileIsNotEverybodys) {
  const std::string lock = path + ".lock";
  const auto mode = [&lock] { return std::filesystem::status(lock).permissions(); };
  const auto of_the_owner = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
  { const auto listening = ListeningSocket::open(path); }
  EXPECT_EQ(mode(), of_the_owner);
  std::filesystem::permissions(lock,
                               std::filesystem::perms::all);  // as an earlier version might have left it
  { EXPECT_TRUE(ListeningSocket::open(path)); }
  EXPECT_EQ(mode(), of_the_owner);
}

TEST_F(UnixSocketTest, LockFileOfAnotherUserIsRefused) {
  const std::string lock = folder.write("s.lock", "");
  if (::chown(lock.c_str(), 65534, 65534) != 0) GTEST_SKIP() << "only root gives files away";
  const auto listening = ListeningSocket::open(path);
  ASSERT_FALSE(listening);
  EXPECT_EQ(listening.error().code, Errc::kPermission);
  EXPECT_THAT(listening.error().message, HasSubstr("found a file of user 65534, expected one of user 0"));
}

TEST_F(UnixSocketTest, LockThatIsNoFileIsRefused) {
  ASSERT_EQ(::mkfifo((path + ".lock").c_str(), 0600), 0);
  const auto listening = ListeningSocket::open(path);
  ASSERT_FALSE(listening);
  EXPECT_EQ(listening.error().code, Errc::kInvalidInput);
}

TEST_F(UnixSocketTest, SecondDaemonIsRefused) {
  const auto first = ListeningSocket::open(path);
  ASSERT_TRUE(first.has_value());
  const auto second = ListeningSocket::open(path);
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, Errc::kBusy);
  EXPECT_THAT(second.error().message, HasSubstr("another process"));
  EXPECT_TRUE(connect_unix(path).has_value());  // the first one's socket is untouched
}

TEST_F(UnixSocketTest, NobodyServesWhereNobodyIs) {
  EXPECT_EQ(serving_process(path), 0);
  { const auto gone = ListeningSocket::open(path); }
  EXPECT_EQ(serving_process(path), 0) << "its lock file has stayed";
}

TEST_F(UnixSocketTest, IsOpenToWhomItIsSaidToBe) {
  const auto mode_of = [this] { return std::filesystem::status(path).permissions(); };
  {
    const auto to_anybody = ListeningSocket::open(path);
    EXPECT_EQ(mode_of(), std::filesystem::perms{0666});
  }
  const auto to_the_owner = ListeningSocket::open(path, 0600);
  EXPECT_EQ(mode_of(), std::filesystem::perms{0600});
}

TEST_F(UnixSocketTest, StaleSocketIsReplaced) {
  const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::close(fd);
  ASSERT_TRUE(std::filesystem::exists(path));
  EXPECT_EQ(connect_unix(path).error().code, Errc::kNotFound);
  const auto listening = ListeningSocket::open(path);
  ASSERT_TRUE(listening.has_value()) << listening.error().message;
  EXPECT_TRUE(connect_unix(path).has_value());
}

TEST_F(UnixSocketTest, FileInTheWayIsNotTouched) {
  std::ofstream(path) << "precious";
  const auto listening = ListeningSocket::open(path);
  ASSERT_FALSE(listening.has_value());
  EXPECT_EQ(listening.error().code, Errc::kInvalidInput);
  EXPECT_EQ(std::filesystem::file_size(path), 8U);
}

// A signal is no answer, and no reason to wait for ever either.
TEST_F(UnixSocketTest, SignalsWhileItWaitsChangeNothing) {
  const auto listening = ListeningSocket::open(path);
  ASSERT_TRUE(listening) << listening.error().message;
  const auto clients = crowd();
  const Interruptions interruptions;
  const types::Stamp begin = monotonic_now();
  const auto client = connect_unix(path, 50ms);
  ASSERT_FALSE(client);
  EXPECT_EQ(client.error().code, Errc::kTimeout) << client.error().message;
  EXPECT_GE(monotonic_now() - begin, 50ms);
  EXPECT_GT(Interruptions::count, 1);
}

TEST_F(UnixSocketTest, WhoWasInterruptedIsTakenUpAllTheSame) {
  const auto listening = ListeningSocket::open(path);
  ASSERT_TRUE(listening) << listening.error().message;
  const auto clients = crowd();
  sigset_t alarm, before;
  ::sigemptyset(&alarm);
  ::sigaddset(&alarm, SIGALRM);
  ::pthread_sigmask(SIG_BLOCK, &alarm, &before);
  const Interruptions interruptions;
  std::thread daemon([&] {  // the signals are not for it
    while (Interruptions::count < 3) std::this_thread::yield();
    const UniqueFd taken(::accept(listening->fd(), nullptr, nullptr));
  });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  auto client = connect_unix(path, 20s);
  daemon.join();
  ASSERT_TRUE(client) << client.error().message;
  EXPECT_EQ(::send(client->get(), "?", 1, MSG_NOSIGNAL), 1);
}

TEST_F(UnixSocketTest, MissingFolderAndLongPath) {
  EXPECT_EQ(ListeningSocket::open(folder.file("no/s")).error().code, Errc::kNotFound);
  EXPECT_EQ(ListeningSocket::open("/" + std::string(200, 'x')).error().code, Errc::kInvalidInput);
}

}  // namespace
}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/unix_socket.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cstring>
#include <fstream>

namespace topo::io {
namespace {

using ::testing::HasSubstr;
using types::Errc;

class UnixSocketTest : public ::testing::Test {
 protected:
  daemon::testing::TempDir folder;
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

TEST_F(UnixSocketTest, SecondDaemonIsRefused) {
  const auto first = ListeningSocket::open(path);
  ASSERT_TRUE(first.has_value());
  const auto second = ListeningSocket::open(path);
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, Errc::kBusy);
  EXPECT_THAT(second.error().message, HasSubstr("another process"));
  EXPECT_TRUE(connect_unix(path).has_value());  // the first one's socket is untouched
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

TEST_F(UnixSocketTest, MissingFolderAndLongPath) {
  EXPECT_EQ(ListeningSocket::open(folder.file("no/s")).error().code, Errc::kNotFound);
  EXPECT_EQ(ListeningSocket::open("/" + std::string(200, 'x')).error().code, Errc::kInvalidInput);
}

}  // namespace
}  // namespace topo::io

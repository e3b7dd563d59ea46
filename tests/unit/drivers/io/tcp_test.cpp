// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/tcp.hpp"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>
#include <string>

#include "drivers/io/make_connector.hpp"
#include "drivers/io/posix.hpp"

namespace topo::io {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using types::Errc;

/// A listening socket on loopback at a port that the kernel chose.
class TcpTest : public testing::Test {
 protected:
  void SetUp() override {
    listener_.reset(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ASSERT_EQ(::bind(listener_.get(), reinterpret_cast<sockaddr*>(&address), size), 0);
    ASSERT_EQ(::listen(listener_.get(), 1), 0);
    ASSERT_EQ(::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&address), &size), 0);
    address_ = "tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    auto connector = make_connector(address_);
    ASSERT_TRUE(connector);
    connector_ = std::move(*connector);
  }

  void open() {
    auto stream = connector_->connect(1s);
    ASSERT_TRUE(stream) << stream.error().message;
    stream_ = std::move(*stream);
    peer_.reset(::accept(listener_.get(), nullptr, nullptr));
    ASSERT_TRUE(peer_.valid());
  }

  UniqueFd listener_, peer_;
  std::string address_;
  std::unique_ptr<Connector> connector_;
  std::unique_ptr<ByteStream> stream_;
};

TEST_F(TcpTest, PassesBytesBothWays) {
  open();
  EXPECT_FALSE(stream_->has_baud());
  EXPECT_TRUE(stream_->set_baud(12345));
  ASSERT_TRUE(stream_->write(std::as_bytes(std::span("hello", 5)), 1s));
  std::array<char, 16> got{};
  ASSERT_EQ(::recv(peer_.get(), got.data(), 5, MSG_WAITALL), 5);
  EXPECT_STREQ(got.data(), "hello");
  ASSERT_EQ(::send(peer_.get(), "world", 5, 0), 5);
  std::array<std::byte, 16> buffer{};
  const auto result = stream_->read(buffer, 1s);
  ASSERT_TRUE(result);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(buffer.data()), result->bytes), "world");
}

TEST_F(TcpTest, ReadsWhatIsThereBeforeItReportsTheClose) {
  open();
  ASSERT_EQ(::send(peer_.get(), "bye", 3, 0), 3);
  peer_.reset();
  std::array<std::byte, 16> buffer{};
  const auto first = stream_->read(buffer, 1s);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->bytes, 3U);
  const auto second = stream_->read(buffer, 1s);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kClosed);
  EXPECT_THAT(second.error().message, HasSubstr(address_));
}

TEST_F(TcpTest, ConnectsAgainAfterALoss) {
  open();
  peer_.reset();
  stream_.reset();
  open();
  EXPECT_TRUE(stream_->write(std::as_bytes(std::span("x", 1)), 1s));
}

TEST_F(TcpTest, RefusalNamesTheAddress) {
  listener_.reset();
  const auto stream = connector_->connect(1s);
  ASSERT_FALSE(stream);
  EXPECT_EQ(stream.error().code, Errc::kNotFound);
  EXPECT_THAT(stream.error().message, HasSubstr(address_));
}

TEST_F(TcpTest, AnUnansweredAttemptReturnsInTimeAndGoesOn) {
  // The accept queue of length 1 holds two connections; further requests get no answer.
  std::array<std::unique_ptr<ByteStream>, 8> fillers;
  std::unique_ptr<Connector> waiting;
  for (auto& filler : fillers) {
    waiting = std::move(*make_connector(address_));
    auto stream = waiting->connect(50ms);
    if (!stream) break;
    filler = std::move(*stream);
    waiting.reset();
  }
  ASSERT_TRUE(waiting) << "the kernel accepted more than its queue";
  const types::Stamp before = monotonic_now();
  const auto still = waiting->connect(20ms);
  ASSERT_FALSE(still);
  EXPECT_EQ(still.error().code, Errc::kTimeout);
  EXPECT_GE(monotonic_now() - before, 20ms);
  // Room in the queue: the same attempt succeeds with the kernel's next request (1 s after the first).
  for (int i = 0; i < 2; ++i) UniqueFd(::accept(listener_.get(), nullptr, nullptr));
  const auto through = waiting->connect(3s);
  EXPECT_TRUE(through) << through.error().message;
}

TEST_F(TcpTest, UnknownHostIsNamed) {
  auto connector = make_connector("tcp:no-such-host.invalid:10940");
  ASSERT_TRUE(connector);
  const auto stream = (*connector)->connect(100ms);
  ASSERT_FALSE(stream);
  EXPECT_THAT(stream.error().message, HasSubstr("no-such-host.invalid"));
}

}  // namespace
}  // namespace topo::io

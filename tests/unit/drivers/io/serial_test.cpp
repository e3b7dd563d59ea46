// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <string>

#include "drivers/io/make_connector.hpp"
#include "drivers/io/posix.hpp"
#include "drivers/io/unique_fd.hpp"

namespace topo::io {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using types::Errc;

/// The real driver of the kernel's pseudo terminals; the master side plays the device.
class PtyTest : public testing::Test {
 protected:
  void SetUp() override {
    int master = -1, slave = -1;
    std::array<char, 128> path{};
    ASSERT_EQ(::openpty(&master, &slave, path.data(), nullptr, nullptr), 0);
    master_.reset(master);
    slave_.reset(slave);
    path_ = path.data();
    auto connector = make_connector("serial:" + path_);
    ASSERT_TRUE(connector);
    connector_ = std::move(*connector);
  }

  void open() {
    auto stream = connector_->connect(100ms);
    ASSERT_TRUE(stream) << stream.error().message;
    stream_ = std::move(*stream);
  }

  std::string read_all(std::size_t expected) {
    std::string got;
    std::array<std::byte, 512> buffer{};
    const types::Stamp deadline = monotonic_now() + 5s;
    while (got.size() < expected && monotonic_now() < deadline) {
      const auto result = stream_->read(buffer, 100ms);
      if (!result) break;
      got.append(reinterpret_cast<const char*>(buffer.data()), result->bytes);
    }
    return got;
  }

  UniqueFd master_, slave_;
  std::string path_;
  std::unique_ptr<Connector> connector_;
  std::unique_ptr<ByteStream> stream_;
};

TEST_F(PtyTest, PassesEveryByteUnchangedBothWays) {
  open();
  std::string all;
  for (int i = 0; i < 256; ++i) all.push_back(static_cast<char>(i));
  ASSERT_EQ(::write(master_.get(), all.data(), all.size()), 256);
  EXPECT_EQ(read_all(256), all);
  ASSERT_TRUE(stream_->write(std::as_bytes(std::span(all)), 1s));
  std::array<char, 256> back{};
  std::size_t got = 0;
  while (got < 256) {
    const ssize_t count = ::read(master_.get(), back.data() + got, back.size() - got);
    ASSERT_GT(count, 0);
    got += static_cast<std::size_t>(count);
  }
  EXPECT_EQ(std::string(back.data(), back.size()), all);
}

TEST_F(PtyTest, StampsAReadWithTheMonotonicClock) {
  open();
  const types::Stamp before = monotonic_now();
  ASSERT_EQ(::write(master_.get(), "x", 1), 1);
  std::array<std::byte, 8> buffer{};
  const auto result = stream_->read(buffer, 1s);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->bytes, 1U);
  EXPECT_GE(result->stamp, before);
  EXPECT_LE(result->stamp, stream_->now());
}

TEST_F(PtyTest, TimeOutIsNoError) {
  open();
  std::array<std::byte, 8> buffer{};
  const types::Stamp before = monotonic_now();
  const auto result = stream_->read(buffer, 20ms);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->bytes, 0U);
  EXPECT_GE(monotonic_now() - before, 20ms);
}

TEST_F(PtyTest, HangUpIsClosedAndWaitingBytesComeFirst) {
  open();
  slave_.reset();
  master_.reset();
  std::array<std::byte, 8> buffer{};
  const auto result = stream_->read(buffer, 1s);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Errc::kClosed);
  EXPECT_THAT(result.error().message, HasSubstr(path_));
  const auto written = stream_->write(std::as_bytes(std::span("x")), 100ms);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::kClosed);
}

TEST_F(PtyTest, SecondOpenIsBusyUntilTheFirstIsGone) {
  open();
  auto again = make_connector(path_);
  ASSERT_TRUE(again);
  const auto second = (*again)->connect(10ms);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::kBusy);
  stream_.reset();
  slave_.reset();
  EXPECT_TRUE((*again)->connect(10ms));
}

TEST_F(PtyTest, SetsTheLineSpeedAndRefusesUnknownOnes) {
  open();
  EXPECT_TRUE(stream_->has_baud());
  for (const auto& [baud, speed] :
       {std::pair{19200, B19200}, std::pair{38400, B38400}, std::pair{115200, B115200}}) {
    ASSERT_TRUE(stream_->set_baud(baud));
    termios settings{};
    ASSERT_EQ(::tcgetattr(slave_.get(), &settings), 0);
    EXPECT_EQ(::cfgetospeed(&settings), static_cast<speed_t>(speed));
    EXPECT_EQ(settings.c_lflag & static_cast<tcflag_t>(ICANON | ECHO | ISIG), 0U);
  }
  const auto odd = stream_->set_baud(12345);
  ASSERT_FALSE(odd);
  EXPECT_EQ(odd.error().code, Errc::kUnsupported);
  EXPECT_THAT(odd.error().message, HasSubstr("12345"));
}

TEST_F(PtyTest, WriteTimesOutWhenNobodyReads) {
  open();
  const std::string much(1 << 20, 'x');
  const auto written = stream_->write(std::as_bytes(std::span(much)), 30ms);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, Errc::kTimeout);
}

}  // namespace
}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/tap.hpp"

#include <gmock/gmock.h>

#include <array>
#include <string>
#include <vector>

#include "tests/mocks/scripted_stream.hpp"

namespace topo::io {
namespace {

using namespace std::chrono_literals;

/// Writes down what it hears.
class NotingTap final : public ByteTap {
 public:
  void on_open(Stamp stamp) noexcept override { note("open", stamp); }
  void on_close(Stamp stamp) noexcept override { note("close", stamp); }
  void on_bytes(Direction direction, Stamp stamp, std::span<const std::byte> bytes) noexcept override {
    note((direction == Direction::kFromDevice ? "<" : ">") +
             std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
         stamp);
  }
  std::vector<std::string> notes;
  std::vector<Stamp> stamps;

 private:
  void note(std::string text, Stamp stamp) {
    notes.push_back(std::move(text));
    stamps.push_back(stamp);
  }
};

TEST(TappedConnector, ReportsEveryByteInOrderWithItsStamp) {
  mocks::ScriptedLine line;
  const Stamp start = line.now;
  line.on_write = [&](std::string_view) { line.send_at(line.now + 5ms, "pong"); };
  NotingTap tap;
  TappedConnector connector(std::make_unique<mocks::ScriptedConnector>(line), &tap);
  {
    auto stream = connector.connect(1s);
    ASSERT_TRUE(stream);
    ASSERT_TRUE((*stream)->write(std::as_bytes(std::span("ping", 4)), 1s));
    std::array<std::byte, 3> buffer{};
    EXPECT_EQ((*stream)->read(buffer, 1s)->bytes, 3U);
    EXPECT_EQ((*stream)->read(buffer, 1s)->bytes, 1U);
    EXPECT_EQ((*stream)->read(buffer, 10ms)->bytes, 0U);
  }
  EXPECT_THAT(tap.notes, testing::ElementsAre("open", ">ping", "<pon", "<g", "close"));
  EXPECT_THAT(tap.stamps, testing::ElementsAre(start, start, start + 5ms, start + 5ms, start + 15ms));
}

/// A bus with a transfer under way and two faults behind it.
class BusyBus final : public ByteStream, public Connector {
 public:
  Result<std::unique_ptr<ByteStream>> connect(Duration /*timeout*/) override {
    return std::make_unique<BusyBus>();
  }
  [[nodiscard]] std::string_view name() const override { return "bus"; }
  Result<ReadResult> read(std::span<std::byte> /*buffer*/, Duration /*timeout*/) override {
    return ReadResult{};
  }
  Status write(std::span<const std::byte> /*bytes*/, Duration /*timeout*/) override { return {}; }
  [[nodiscard]] bool ready() const override { return false; }
  [[nodiscard]] BusFaults faults() const override {
    BusFaults faults;
    faults[BusFault::kPassive] = 2;
    return faults;
  }
  Status set_baud(int /*baud*/) override { return {}; }
  [[nodiscard]] bool has_baud() const override { return false; }
  [[nodiscard]] Stamp now() const override { return {}; }
};

TEST(TappedConnector, HidesNothingOfABus) {
  NotingTap tap;
  TappedConnector connector(std::make_unique<BusyBus>(), &tap);
  const auto stream = connector.connect(1s);
  ASSERT_TRUE(stream);
  EXPECT_FALSE((*stream)->ready());
  EXPECT_EQ((*stream)->faults()[BusFault::kPassive], 2U);
}

TEST(TappedConnector, AFailedConnectionIsNotReported) {
  mocks::ScriptedLine line;
  line.refuse = true;
  NotingTap tap;
  TappedConnector connector(std::make_unique<mocks::ScriptedConnector>(line), &tap);
  EXPECT_FALSE(connector.connect(1s));
  EXPECT_TRUE(tap.notes.empty());
  EXPECT_EQ(connector.name(), "/dev/scripted");
  const Stamp before = line.now;
  connector.pause(2s);
  EXPECT_EQ(connector.now(), before + 2s);
}

}  // namespace
}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/replay.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "tests/unit/daemon/recording/recording_samples.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using testing::bytes_of;
using testing::HandMade;
using ::testing::HasSubstr;
using testing::text_of;
using types::Errc;
using types::Stamp;

class ReplayTest : public ::testing::Test {
 protected:
  void play(HandMade& made, ReplayOptions options = {}) {
    ASSERT_TRUE(made.frame());
    auto replay = Replay::open(dir_.file("a.rec"), options);
    ASSERT_TRUE(replay.has_value()) << replay.error().message;
    replay_ = *replay;
  }
  std::unique_ptr<io::Connector> connector(std::string_view channel) {
    auto made = Replay::connector(replay_, channel, false);
    EXPECT_TRUE(made.has_value());
    return made.has_value() ? std::move(*made) : nullptr;
  }
  HandMade record() { return {dir_.file("a.rec"), {"front", "base"}}; }

  /// The next bytes, however long they take.
  static std::pair<std::string, Stamp> read(io::ByteStream& stream) {
    std::array<std::byte, 64> buffer{};
    const auto got = stream.read(buffer, 10s);
    return got.has_value() ? std::pair{text_of(std::span(buffer).first(got->bytes)), got->stamp}
                           : std::pair{got.error().message, Stamp{}};
  }
  static bool at_end(io::ByteStream& stream) {
    std::array<std::byte, 64> buffer{};
    const auto got = stream.read(buffer, 10s);
    return !got.has_value() && got.error().code == Errc::kClosed;
  }

  testing::TempDir dir_;
  std::shared_ptr<Replay> replay_;
};

TEST_F(ReplayTest, PlaysInItsOwnPaceWithStampsMovedByOneOffset) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 0)
      .add(1, RecordKind::kOpen, 0)
      .add(0, RecordKind::kFromDevice, 5, "a")
      .add(1, RecordKind::kFromDevice, 12, "b")
      .add(0, RecordKind::kFromDevice, 40, "c");
  play(made);
  const auto front = connector("front"), base = connector("base");
  const Stamp before = io::monotonic_now();
  auto front_stream = front->connect(1s), base_stream = base->connect(1s);
  ASSERT_TRUE(front_stream.has_value() && base_stream.has_value());
  const auto [a, a_stamp] = read(**front_stream);
  const auto [b, b_stamp] = read(**base_stream);
  const auto [c, c_stamp] = read(**front_stream);
  EXPECT_EQ(a + b + c, "abc");
  EXPECT_EQ(b_stamp - a_stamp, 7ms);
  EXPECT_EQ(c_stamp - a_stamp, 35ms);
  EXPECT_GE(a_stamp, before + 5ms);
  EXPECT_GE(io::monotonic_now(), c_stamp);  // nothing comes before its time
  EXPECT_TRUE(at_end(**front_stream));
  EXPECT_FALSE(replay_->finished());
  EXPECT_TRUE(at_end(**base_stream));
  EXPECT_TRUE(replay_->finished());
}

TEST_F(ReplayTest, AReadTimesOutWithoutErrorAndSmallBuffersTakePieces) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 0).add(0, RecordKind::kFromDevice, 50, "abcdef");
  play(made);
  auto stream = connector("front")->connect(1s);
  ASSERT_TRUE(stream.has_value());
  std::array<std::byte, 4> buffer{};
  const auto none = (*stream)->read(buffer, 0ms);
  ASSERT_TRUE(none.has_value());
  EXPECT_EQ(none->bytes, 0U);
  const auto first = (*stream)->read(buffer, 10s), second = (*stream)->read(buffer, 10s);
  ASSERT_TRUE(first.has_value() && second.has_value());
  EXPECT_EQ(first->bytes, 4U);
  EXPECT_EQ(second->bytes, 2U);
  EXPECT_EQ(first->stamp, second->stamp);
}

TEST_F(ReplayTest, AnswersWaitForTheirQuestions) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 0)
      .add(0, RecordKind::kToDevice, 1, "VV\n")
      .add(0, RecordKind::kFromDevice, 2, "answer");
  play(made, {.gate_timeout = 1h});
  auto stream = connector("front")->connect(1s);
  ASSERT_TRUE(stream.has_value());
  std::array<std::byte, 64> buffer{};
  for (const std::string_view part : {"V", "V"}) {
    ASSERT_TRUE((*stream)->write(bytes_of(part), 1s).has_value());
    const auto early = (*stream)->read(buffer, 5ms);
    ASSERT_TRUE(early.has_value());
    EXPECT_EQ(early->bytes, 0U);
  }
  const Stamp asked = (*stream)->now();
  ASSERT_TRUE((*stream)->write(bytes_of("\n"), 1s).has_value());
  const auto [text, stamp] = read(**stream);
  EXPECT_EQ(text, "answer");
  EXPECT_GE(stamp, asked);  // no negative round trip
  EXPECT_EQ(replay_->gates_released(), 0);
}

TEST_F(ReplayTest, AQuestionThatNeverComesIsNotWaitedForLong) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 0)
      .add(0, RecordKind::kToDevice, 1, "xx")
      .add(0, RecordKind::kFromDevice, 2, "one")
      .add(0, RecordKind::kToDevice, 3, "yy")
      .add(0, RecordKind::kFromDevice, 4, "two");
  play(made, {.gate_timeout = 20ms});
  auto stream = connector("front")->connect(1s);
  ASSERT_TRUE(stream.has_value());
  const auto [one, stamp] = read(**stream);
  EXPECT_EQ(one, "one");
  EXPECT_GE(io::monotonic_now(), stamp + 20ms);
  EXPECT_EQ(read(**stream).first, "two");
  EXPECT_EQ(replay_->gates_released(), 1);
}

TEST_F(ReplayTest, OpeningsAndClosingsHappenAgain) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 20)
      .add(0, RecordKind::kFromDevice, 21, "first")
      .add(0, RecordKind::kClose, 25)
      .add(0, RecordKind::kOpen, 60)
      .add(0, RecordKind::kFromDevice, 61, "second")
      .add(0, RecordKind::kEnd, 62);
  play(made);
  const auto front = connector("front");
  const auto early = front->connect(0ms);
  ASSERT_FALSE(early.has_value());
  EXPECT_EQ(early.error().code, Errc::kTimeout);
  {
    auto stream = front->connect(10s);
    ASSERT_TRUE(stream.has_value());
    EXPECT_EQ(read(**stream).first, "first");
    EXPECT_TRUE(at_end(**stream));
    EXPECT_TRUE(at_end(**stream));
  }
  auto stream = front->connect(10s);
  ASSERT_TRUE(stream.has_value());
  EXPECT_EQ(read(**stream).first, "second");
  EXPECT_FALSE(replay_->finished());
  EXPECT_TRUE(at_end(**stream));
  EXPECT_TRUE(replay_->finished());
  const auto late = front->connect(0ms);
  ASSERT_FALSE(late.has_value());
  EXPECT_EQ(late.error().code, Errc::kClosed);
}

TEST_F(ReplayTest, AStreamGivenUpEarlyGoesOnAtTheNextOpening) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 0)
      .add(0, RecordKind::kFromDevice, 1, "left out")
      .add(0, RecordKind::kClose, 2)
      .add(0, RecordKind::kOpen, 3)
      .add(0, RecordKind::kFromDevice, 4, "next");
  play(made);
  const auto front = connector("front");
  ASSERT_TRUE(front->connect(1s).has_value());
  auto stream = front->connect(1s);
  ASSERT_TRUE(stream.has_value());
  EXPECT_EQ(read(**stream).first, "next");
}

TEST_F(ReplayTest, AMissingChannelIsNamedWithThoseThatAreThere) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 0);
  play(made);
  const auto none = Replay::connector(replay_, "coronal", false);
  ASSERT_FALSE(none.has_value());
  EXPECT_THAT(none.error().message, HasSubstr("found channels front, base, expected coronal"));
}

TEST_F(ReplayTest, ChannelsPlayOnThreadsOfTheirOwn) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 0).add(1, RecordKind::kOpen, 0);
  std::string expected;
  for (int i = 0; i < 200; ++i) {
    const std::string text = std::to_string(i) + ";";
    made.add(0, RecordKind::kFromDevice, i / 10, text).add(1, RecordKind::kFromDevice, i / 10, text);
    expected += text;
    if (i % 50 == 0) {
      ASSERT_TRUE(made.frame());
    }
  }
  play(made);
  std::array<std::string, 2> got;
  std::array<std::unique_ptr<io::Connector>, 2> connectors{connector("front"), connector("base")};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 2; ++i) {
    threads.emplace_back([&got, &connectors, i] {
      auto stream = connectors[i]->connect(1s);
      std::array<std::byte, 16> buffer{};
      while (stream.has_value()) {
        const auto n = (*stream)->read(buffer, 1s);
        if (!n.has_value()) break;
        got[i] += text_of(std::span(buffer).first(n->bytes));
      }
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(got[0], expected);
  EXPECT_EQ(got[1], expected);
  EXPECT_TRUE(replay_->finished());
}

TEST_F(ReplayTest, AtOnceTakesNoTimeAndKeepsTheRecordedTimes) {
  HandMade made = record();
  made.add(0, RecordKind::kOpen, 0)
      .add(0, RecordKind::kFromDevice, 5, "a")
      .add(0, RecordKind::kFromDevice, 3'600'000, "b");
  play(made, {.gate_timeout = 1s, .gate_span = 10s, .at_once = true});
  const auto front = connector("front");
  auto stream = front->connect(1s);
  ASSERT_TRUE(stream.has_value());
  const Stamp before = io::monotonic_now();
  const auto [a, a_stamp] = read(**stream);
  std::pair<std::string, Stamp> next;
  while (next.first.empty()) next = read(**stream);  // each waits at most ten seconds of the recording
  EXPECT_EQ(a + next.first, "ab");
  EXPECT_EQ(next.second - a_stamp, 3'599'995ms);
  EXPECT_EQ((*stream)->now(), next.second);
  EXPECT_LT(io::monotonic_now() - before, 60s);
  EXPECT_TRUE(at_end(**stream));
  EXPECT_TRUE(replay_->finished());
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/recorder.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>

#include <atomic>

#include "daemon/recording/recording_reader.hpp"
#include "daemon/recording/summary.hpp"
#include "tests/unit/daemon/recording/recording_samples.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using testing::bytes_of;
using ::testing::HasSubstr;
using testing::text_of;
using testing::wait_for;
using types::Duration;
using types::Errc;
using types::Stamp;

Stamp at(int ms) { return Stamp{Duration{1h}} + std::chrono::milliseconds(ms); }

RecorderOptions options(const std::string& path) {
  RecorderOptions o;
  o.path = path;
  o.channels = {"front", "base"};
  o.poll_period = 1ms;
  o.frame_period = 5ms;
  return o;
}

RecordingSummary summary_of(const std::string& path) {
  const auto reader = RecordingReader::open(path);
  EXPECT_TRUE(reader.has_value());
  return reader.has_value() ? summarise(*reader) : RecordingSummary{};
}

TEST(Recorder, WritesWhatTheTapsHeardWithStamps) {
  const testing::TempDir dir;
  auto recorder = Recorder::start(options(dir.file("a.rec")));
  ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
  io::ByteTap* front = (*recorder)->tap("front");
  ASSERT_NE(front, nullptr);
  EXPECT_EQ((*recorder)->tap("coronal"), nullptr);
  front->on_open(at(0));
  front->on_bytes(io::Direction::kToDevice, at(1), bytes_of("VV\n"));
  front->on_bytes(io::Direction::kFromDevice, at(2), bytes_of("VV\n00P\n\n"));
  (*recorder)->tap("base")->on_open(at(3));
  front->on_close(at(4));
  ASSERT_TRUE((*recorder)->stop().has_value());
  const auto reader = RecordingReader::open(dir.file("a.rec"));
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  RecordingCursor cursor(*reader, 0);
  for (const auto& [kind, stamp, text] :
       {std::tuple{RecordKind::kOpen, at(0), ""}, std::tuple{RecordKind::kToDevice, at(1), "VV\n"},
        std::tuple{RecordKind::kFromDevice, at(2), "VV\n00P\n\n"},
        std::tuple{RecordKind::kClose, at(4), ""}}) {
    const auto record = cursor.next();
    ASSERT_TRUE(record.has_value() && record->has_value());
    EXPECT_EQ((*record)->kind, kind);
    EXPECT_EQ((*record)->stamp, stamp);
    EXPECT_EQ(text_of((*record)->bytes), text);
  }
  EXPECT_TRUE(summary_of(dir.file("a.rec")).ended_orderly);
  EXPECT_EQ((*recorder)->stats().recorded_bytes, 11U);
}

TEST(Recorder, LongPiecesAreSplitAndComeBackWhole) {
  const testing::TempDir dir;
  std::string text(300000, '\0');
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(i * i % 251);
  auto recorder = Recorder::start(options(dir.file("a.rec")));
  ASSERT_TRUE(recorder.has_value());
  (*recorder)->tap("base")->on_bytes(io::Direction::kFromDevice, at(0), bytes_of(text));
  ASSERT_TRUE((*recorder)->stop().has_value());
  const auto reader = RecordingReader::open(dir.file("a.rec"));
  ASSERT_TRUE(reader.has_value());
  EXPECT_GE((*reader)->frames(), 2U);
  RecordingCursor cursor(*reader, 1);
  std::string got;
  for (auto record = cursor.next(); record.has_value() && record->has_value(); record = cursor.next())
    got += text_of((*record)->bytes);
  EXPECT_EQ(got, text);
}

TEST(Recorder, WhatFindsNoRoomIsCountedAndMarkedInItsPlace) {
  const testing::TempDir dir;
  RecorderOptions o = options(dir.file("a.rec"));
  o.ring_bytes = 2 * kMaxRecordBytes;
  o.poll_period = 1h;  // nobody empties the ring before it is full
  auto recorder = Recorder::start(o);
  ASSERT_TRUE(recorder.has_value());
  ChannelTap tap(0, 2 * kMaxRecordBytes);  // the same ring, emptied by hand
  const std::string piece(30000, 'x');
  for (int i = 0; i < 5; ++i) tap.on_bytes(io::Direction::kFromDevice, at(i), bytes_of(piece));
  EXPECT_EQ(tap.lost_records(), 3U);
  EXPECT_EQ(tap.lost_bytes(), 90000U);
  tap.ring().drop(tap.ring().size());
  tap.on_bytes(io::Direction::kFromDevice, at(9), bytes_of("after"));
  std::array<std::byte, RecordHead::kSize> head{};
  tap.ring().peek(head);
  const auto gap = decode_record_head(head);
  ASSERT_TRUE(gap.has_value());
  EXPECT_EQ(gap->kind, RecordKind::kGap);
  EXPECT_EQ(tap.ring().size(), RecordHead::kSize + 16 + RecordHead::kSize + 5);

  for (int i = 0; i < 5; ++i)
    (*recorder)->tap("front")->on_bytes(io::Direction::kFromDevice, at(i), bytes_of(piece));
  ASSERT_TRUE((*recorder)->stop().has_value());
  EXPECT_EQ((*recorder)->stats().lost_bytes, 90000U);
  EXPECT_EQ((*recorder)->stats().recorded_bytes, 60000U);
}

TEST(Recorder, AKilledRecorderLeavesWholeFrames) {
  const testing::TempDir dir;
  auto recorder = Recorder::start(options(dir.file("a.rec")));
  ASSERT_TRUE(recorder.has_value());
  (*recorder)->tap("front")->on_bytes(io::Direction::kFromDevice, at(0), bytes_of("before the end"));
  ASSERT_TRUE(wait_for([&] { return (*recorder)->stats().frames > 0; }));
  const std::string now = testing::read_all(dir.file("a.rec"));  // as a kill would leave it
  ASSERT_TRUE((*recorder)->stop().has_value());
  const RecordingSummary summary = summary_of(dir.write("killed.rec", now));
  EXPECT_EQ(summary.channels[0].from_device_bytes, 14U);
  EXPECT_FALSE(summary.ended_orderly);
  EXPECT_TRUE(summary.damages.empty());
}

TEST(Recorder, RefusesBadOptionsAndExistingFiles) {
  const testing::TempDir dir;
  const auto message = [](RecorderOptions o) {
    const auto recorder = Recorder::start(std::move(o));
    return recorder.has_value() ? std::string() : recorder.error().message;
  };
  EXPECT_THAT(message(options(dir.write("old.rec", "precious"))),
              HasSubstr("old.rec: found an existing file"));
  EXPECT_EQ(testing::read_all(dir.file("old.rec")), "precious");
  EXPECT_THAT(message(options(dir.file("no/such/folder.rec"))), HasSubstr("folder.rec"));
  RecorderOptions none = options(dir.file("b.rec"));
  none.channels.clear();
  EXPECT_THAT(message(none), HasSubstr("found 0 channels"));
  RecorderOptions ring = options(dir.file("b.rec"));
  ring.ring_bytes = 100000;
  EXPECT_THAT(message(ring), HasSubstr("rings of 100000 bytes"));
}

/// Files of this process cannot grow beyond a size: to a writer that is a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    rlimit limit = old_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &old_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit old_{};
};

/// A recorder whose warnings are kept.
class WarningRecorder : public ::testing::Test {
 protected:
  void SetUp() override {
    RecorderOptions o = options(dir.file("a.rec"));
    o.on_warning = [this](const std::string& text) { warnings.push_back(text); };
    auto started = Recorder::start(o);
    ASSERT_TRUE(started.has_value()) << started.error().message;
    recorder = std::move(*started);
  }

  testing::TempDir dir;
  std::vector<std::string> warnings;  ///< written by the recorder's thread, read after stop()
  std::unique_ptr<Recorder> recorder;
};

TEST_F(WarningRecorder, AFullDiskIsToldOnceCountedAndSurvived) {
  io::ByteTap* tap = recorder->tap("front");
  std::string noise(20000, '\0');
  std::uint32_t state = 1;
  for (char& c : noise) c = static_cast<char>((state = state * 1664525U + 1013904223U) >> 24U);
  {
    const FullDisk full(10000);
    for (std::uint64_t n = 1; n <= 3; ++n) {
      tap->on_bytes(io::Direction::kFromDevice, at(0), bytes_of(noise));
      ASSERT_TRUE(wait_for([&] { return recorder->stats().lost_frames >= n; }));
    }
  }
  tap->on_bytes(io::Direction::kFromDevice, at(1), bytes_of("room again"));
  const auto stopped = recorder->stop();
  ASSERT_FALSE(stopped.has_value());
  EXPECT_THAT(stopped.error().message, HasSubstr("a.rec: cannot write"));
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_THAT(warnings[0], HasSubstr("lost from the recording"));
  EXPECT_THAT(warnings[1], HasSubstr("takes the recording again"));
  const RecordingSummary summary = summary_of(dir.file("a.rec"));
  EXPECT_EQ(summary.missing_frames, recorder->stats().lost_frames);
  EXPECT_EQ(summary.channels[0].from_device_bytes, 10U);
  EXPECT_TRUE(summary.damages.empty());
}

TEST_F(WarningRecorder, ADiskThatIsFullToTheEndTakesNothingAgain) {
  const FullDisk full(1);
  recorder->tap("front")->on_bytes(io::Direction::kFromDevice, at(0), bytes_of("too much"));
  EXPECT_FALSE(recorder->stop().has_value());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("lost from the recording"));
}

}  // namespace
}  // namespace topo::daemon

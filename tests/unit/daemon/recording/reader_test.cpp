// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/recording_reader.hpp"

#include <gmock/gmock.h>

#include <random>

#include "daemon/recording/summary.hpp"
#include "tests/unit/daemon/recording/recording_samples.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using testing::HandMade;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::text_of;
using types::Errc;

class RecordingReaderTest : public ::testing::Test {
 protected:
  /// Three frames; channel 1 is in the first and the third.
  std::string make(const std::string& name = "a.rec") {
    HandMade made(dir_.file(name), {"front", "base"});
    made.add(0, RecordKind::kOpen, 0)
        .add(1, RecordKind::kOpen, 1)
        .add(1, RecordKind::kToDevice, 2, "hello")
        .add(0, RecordKind::kFromDevice, 3, "one");
    EXPECT_TRUE(made.frame());
    made.add(0, RecordKind::kFromDevice, 4, "two");
    EXPECT_TRUE(made.frame());
    made.add(1, RecordKind::kFromDevice, 5, "three").add(0, RecordKind::kEnd, 2000);
    EXPECT_TRUE(made.frame());
    return dir_.file(name);
  }
  static std::string read_channel(const std::shared_ptr<const RecordingReader>& reader,
                                  std::optional<std::size_t> channel) {
    std::string text;
    RecordingCursor cursor(reader, channel);
    for (auto record = cursor.next(); record.has_value() && record->has_value(); record = cursor.next()) {
      text += text_of((*record)->bytes) + ".";
    }
    return text;
  }
  testing::TempDir dir_;
};

TEST_F(RecordingReaderTest, ReadsHeaderAndChannels) {
  const auto reader = RecordingReader::open(make());
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_EQ((*reader)->header().config_hash, 77U);
  EXPECT_EQ((*reader)->header().steady_start_ns, HandMade::kStart_ns);
  EXPECT_EQ((*reader)->channel("base"), 1U);
  EXPECT_FALSE((*reader)->channel("coronal").has_value());
  EXPECT_EQ((*reader)->frames(), 3U);
  EXPECT_FALSE((*reader)->damage().has_value());
  EXPECT_EQ(read_channel(*reader, 0), ".one.two..");
  EXPECT_EQ(read_channel(*reader, 1), ".hello.three..");
  EXPECT_EQ(read_channel(*reader, std::nullopt), "..hello.one.two.three..");
}

TEST_F(RecordingReaderTest, ACutRecordingIsReadableUpToItsLastWholeFrame) {
  const std::string whole = testing::read_all(make());
  const auto reader = RecordingReader::open(dir_.file("a.rec"));
  ASSERT_TRUE(reader.has_value());
  const std::string all = read_channel(*reader, std::nullopt);
  std::size_t cuts_with_data = 0;
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const auto cut = RecordingReader::open(dir_.write("cut.rec", whole.substr(0, n)));
    if (!cut.has_value()) {
      EXPECT_EQ(cut.error().code, Errc::kInvalidInput);
      EXPECT_THAT(cut.error().message, HasSubstr("cut.rec: at byte"));
      continue;
    }
    const std::string got = read_channel(*cut, std::nullopt);
    EXPECT_EQ(got, all.substr(0, got.size()));
    EXPECT_LT(got.size(), all.size());
    cuts_with_data += got.empty() ? 0U : 1U;
    if ((*cut)->damage().has_value()) {
      EXPECT_THAT((*cut)->damage()->message, HasSubstr("cut.rec: at byte"));
    }
    EXPECT_FALSE(summarise(*cut).ended_orderly);
  }
  EXPECT_GT(cuts_with_data, 100U);
}

TEST_F(RecordingReaderTest, ADamagedFrameIsToldAndTheNextOneRead) {
  std::string bytes = testing::read_all(make());
  const std::size_t second = bytes.find("TFRM", bytes.find("TFRM") + 4);
  bytes[second + FrameHead::kSize + 3] = static_cast<char>(bytes[second + FrameHead::kSize + 3] ^ 1);
  const auto reader = RecordingReader::open(dir_.write("bad.rec", bytes));
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  const RecordingSummary summary = summarise(*reader);
  ASSERT_EQ(summary.damages.size(), 1U);
  EXPECT_THAT(summary.damages[0], HasSubstr("frame 1 with a wrong checksum"));
  EXPECT_EQ(summary.channels[1].from_device_bytes, 5U);
  EXPECT_EQ(summary.channels[0].from_device_bytes, 3U);
  EXPECT_TRUE(summary.ended_orderly);
}

TEST_F(RecordingReaderTest, SummarySaysBytesDurationAndLosses) {
  const std::string body = std::string("\x05\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0", 16);
  {
    HandMade made(dir_.file("b.rec"), {"front"});
    made.add(0, RecordKind::kOpen, 0)
        .add(0, RecordKind::kGap, 1, body)
        .add(0, RecordKind::kToDevice, 2500, "12");
    ASSERT_TRUE(made.frame());
  }
  const auto reader = RecordingReader::open(dir_.file("b.rec"));
  ASSERT_TRUE(reader.has_value());
  const RecordingSummary summary = summarise(*reader);
  EXPECT_DOUBLE_EQ(summary.duration_s, 2.5);
  EXPECT_EQ(summary.channels[0].lost_bytes, 5U);
  EXPECT_EQ(summary.channels[0].lost_records, 2U);
  EXPECT_EQ(summary.channels[0].opens, 1U);
  EXPECT_THAT(format_summary(summary), HasSubstr("2.5 s in 1 frames, broken off"));
  EXPECT_THAT(format_summary(summary),
              HasSubstr("front: 0 bytes from the device, 2 to it, opened 1 times; lost 5 bytes in 2 pieces"));
}

TEST_F(RecordingReaderTest, NamesFilesThatAreNone) {
  const auto missing = RecordingReader::open(dir_.file("none.rec"));
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, Errc::kNotFound);
  EXPECT_THAT(missing.error().message, HasSubstr("none.rec"));
  const auto other = RecordingReader::open(dir_.write("map.pgm", "P5 1 1 255 x"));
  ASSERT_FALSE(other.has_value());
  EXPECT_THAT(other.error().message,
              HasSubstr("map.pgm: at byte 0: found other content, expected a recording"));
  EXPECT_FALSE(RecordingReader::open(dir_.str()).has_value());
}

TEST_F(RecordingReaderTest, SurvivesAnyDamage) {
  const std::string good = testing::read_all(make());
  std::mt19937 random(11);  // NOLINT: the same damage every time
  int noticed = 0;
  for (int i = 0; i < 400; ++i) {
    std::string bad = good;
    for (auto flips = random() % 4; flips + 1 > 0; --flips) {
      bad[random() % bad.size()] = static_cast<char>(random());
      if (flips == 0) break;
    }
    if (random() % 3 == 0) bad.resize(random() % bad.size());
    const auto reader = RecordingReader::open(dir_.write("mutant.rec", bad));
    if (!reader.has_value()) {
      ++noticed;
      continue;
    }
    const RecordingSummary summary = summarise(*reader);
    noticed += summary.damages.empty() && summary.ended_orderly ? 0 : 1;
  }
  EXPECT_GT(noticed, 350);
}

TEST_F(RecordingReaderTest, RightChecksumsOverHostileRecordsAreNoHarm) {
  std::mt19937 random(12);  // NOLINT: the same records every time
  for (int i = 0; i < 200; ++i) {
    const std::string path = dir_.file("hostile" + std::to_string(i));
    auto writer = FrameWriter::create(path, {0, 0, 0, {"front"}});
    ASSERT_TRUE(writer.has_value());
    std::vector<std::byte> records(random() % 100);
    for (std::byte& b : records) b = random() % 2 == 0 ? std::byte{0} : static_cast<std::byte>(random());
    ASSERT_TRUE(writer->write(records, 1).has_value());
    const auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader.has_value());
    const RecordingSummary summary = summarise(*reader);
    EXPECT_LE(summary.channels[0].from_device_bytes, 100U);
  }
}

}  // namespace
}  // namespace topo::daemon

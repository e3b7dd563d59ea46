// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/format.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include "tests/unit/daemon/recording/recording_samples.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;

TEST(RecordingFormat, HeadersComeBackAsTheyWere) {
  EXPECT_TRUE(rc::check([](std::uint64_t hash, std::uint32_t wall, std::uint32_t steady,
                           const std::vector<std::string>& names) {
    RC_PRE(names.size() <= kMaxChannels);
    RecordingHeader header{hash, wall, steady, names};
    for (std::string& name : header.channels) name.resize(std::min(name.size(), kMaxChannelName));
    const auto bytes = encode_header(header);
    const auto decoded = decode_header(bytes);
    RC_ASSERT(decoded.header.has_value());
    RC_ASSERT(*decoded.header == header);
    RC_ASSERT(decoded.bytes == bytes.size());
  }));
}

TEST(RecordingFormat, RecordHeadsComeBackAsTheyWere) {
  EXPECT_TRUE(rc::check([](std::uint8_t channel, std::uint32_t stamp_ns) {
    const auto kind = *rc::gen::element(RecordKind::kFromDevice, RecordKind::kGap, RecordKind::kEnd);
    const auto length = *rc::gen::inRange<std::uint32_t>(0, kMaxRecordBytes + 1);
    const auto back = decode_record_head(
        encode_record_head({channel, kind, length, types::Stamp{types::Duration{stamp_ns}}}));
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->channel == channel);
    RC_ASSERT(back->kind == kind);
    RC_ASSERT(back->length == length);
    RC_ASSERT(back->stamp.time_since_epoch().count() == stamp_ns);
  }));
}

TEST(RecordingFormat, EveryFlippedBitOfAFrameHeadIsNoticed) {
  const auto good = encode_frame_head({1000, 2000, 5, 42, 0x123456789ABCDEF0U});
  ASSERT_TRUE(decode_frame_head(good).has_value());
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    auto bad = good;
    bad[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    EXPECT_FALSE(decode_frame_head(bad).has_value()) << "bit " << bit;
  }
}

TEST(RecordingFormat, SizesThatAPeerCouldInventAreRefused) {
  EXPECT_FALSE(decode_frame_head(encode_frame_head({kMaxFrameBytes + 1, 1, 0, 0, 0})).has_value());
  EXPECT_FALSE(decode_frame_head(encode_frame_head({1, kMaxFrameBytes + 1, 0, 0, 0})).has_value());
  EXPECT_FALSE(
      decode_record_head(encode_record_head({0, RecordKind::kOpen, kMaxRecordBytes + 1, {}})).has_value());
  EXPECT_FALSE(
      decode_record_head(encode_record_head({0, RecordKind::kOpen, 0, types::Stamp::max()})).has_value());
}

TEST(RecordingFormat, HeaderFaultsSayPlaceFoundAndExpected) {
  const auto good = encode_header({1, 2, 3, {"front", "base"}});
  const auto fault = [](std::vector<std::byte> bytes) {
    const auto decoded = decode_header(bytes);
    EXPECT_FALSE(decoded.header.has_value());
    return decoded.fault;
  };
  EXPECT_EQ(fault({}).found, "an empty file");
  EXPECT_THAT(fault({std::byte{'P'}, std::byte{'5'}}).expected, HasSubstr("TOPOREC"));
  auto version = good;
  version[8] = std::byte{9};
  EXPECT_EQ(fault(version).found, "format version 9");
  EXPECT_EQ(fault(version).expected, "version 1");
  EXPECT_EQ(fault(version).offset, 8U);
  auto flipped = good;
  flipped[20] ^= std::byte{1};
  EXPECT_THAT(fault(flipped).found, HasSubstr("checksum"));
  for (std::size_t n = 0; n < good.size(); ++n)
    fault({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(n)});
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/scip_codec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

namespace topo::hokuyo {
namespace {

using Kind = StreamRequest::Kind;

TEST(ScipCodec, ChecksumsOfKnownStatusLines) {
  for (const char* line : {"00P", "99b", "01Q", "02R", "03S", "04T", "05U", "10Q", "0Bb", "0Cc", "0Dd", "0Ee",
                           "0Ff", "0Ll", "98a"}) {
    EXPECT_TRUE(checked(line)) << line;
    std::string wrong = line;
    wrong.back() = static_cast<char>(wrong.back() ^ 1);
    EXPECT_FALSE(checked(wrong)) << wrong;
  }
  EXPECT_FALSE(checked(""));
  EXPECT_FALSE(checked("P"));
}

TEST(ScipCodec, DecodesThePublishedNumbers) {
  EXPECT_EQ(decode_number("CB"), 1234U);
  EXPECT_EQ(decode_number("1Dh"), 5432U);
  EXPECT_EQ(decode_number("m2@0"), 16000000U);
  EXPECT_EQ(decode_number("0?X"), 1000U);
  EXPECT_EQ(decode_number("?om"), 65533U);
  EXPECT_EQ(decode_number(">YP"), 60000U);
  EXPECT_EQ(decode_number("00G"), 23U);
  EXPECT_EQ(decode_number("oo"), 4095U);
  EXPECT_EQ(decode_number("ooo"), 262143U);
  EXPECT_EQ(decode_number("oooo"), 16777215U);
}

TEST(ScipCodec, RefusesCharactersOutsideTheAlphabet) {
  for (const char* text : {"", "0/0", "p00", "0 0", "000000", "&00", "\x7f"})
    EXPECT_FALSE(decode_number(text)) << text;
}

TEST(ScipCodec, EncodesRequests) {
  StreamRequest request{Kind::kRange, 0, 1080, 1, 0, 0};
  EXPECT_EQ(encode(request).view(), "MD0000108001000");
  request = {Kind::kRangeIntensity, 44, 725, 3, 2, 10};
  EXPECT_EQ(encode(request).view(), "ME0044072503210");
}

TEST(ScipCodec, EchoesReadBackWhatWasEncoded) {
  EXPECT_TRUE(rc::check([] {
    StreamRequest request;
    request.kind = *rc::gen::element(Kind::kRange, Kind::kRangeShort, Kind::kRangeIntensity, Kind::kMultiEcho,
                                     Kind::kMultiIntensity);
    request.start = *rc::gen::inRange<std::uint16_t>(0, 10000);
    request.end = *rc::gen::inRange<std::uint16_t>(0, 10000);
    request.cluster = *rc::gen::inRange<std::uint8_t>(0, 100);
    request.interval = *rc::gen::inRange<std::uint8_t>(0, 10);
    request.count = *rc::gen::inRange<std::uint8_t>(0, 100);
    const auto echo = parse_stream_echo(encode(request).view());
    RC_ASSERT(echo.has_value());
    RC_ASSERT(echo->same_stream(request));
    RC_ASSERT(echo->count == request.count);
  }));
}

TEST(ScipCodec, RefusesWhatIsNoStreamEcho) {
  for (const char* text : {"", "MD", "MD000010800100", "MD00001080010000", "MX0000108001000",
                           "MD00001080010x0", "QT", "GD000010800100x"}) {
    EXPECT_FALSE(parse_stream_echo(text)) << text;
  }
}

TEST(ScipCodec, CountsPointsWithClusters) {
  EXPECT_EQ((StreamRequest{Kind::kRange, 0, 1080, 1, 0, 0}).points(), 1081U);
  EXPECT_EQ((StreamRequest{Kind::kRange, 0, 1080, 0, 0, 0}).points(), 1081U);
  EXPECT_EQ((StreamRequest{Kind::kRange, 0, 1080, 3, 0, 0}).points(), 361U);
  EXPECT_EQ((StreamRequest{Kind::kRange, 44, 725, 1, 0, 0}).points(), 682U);
  EXPECT_EQ((StreamRequest{Kind::kRange, 5, 4, 1, 0, 0}).points(), 0U);
}

}  // namespace
}  // namespace topo::hokuyo

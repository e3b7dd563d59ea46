// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/scip_parser.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/drivers/hokuyo/scip_text.hpp"

namespace topo::hokuyo {
namespace {

using namespace testing_scip;
using Event = ScipParser::Event;
using testing::ElementsAre;

struct Heard {
  std::vector<std::vector<std::uint32_t>> scans;
  std::vector<std::uint32_t> times;
  std::vector<std::string> replies;
  int garbage = 0;
  friend bool operator==(const Heard&, const Heard&) = default;
};

void feed(ScipParser& parser, std::string_view text, Heard& heard) {
  auto bytes = std::as_bytes(std::span(text));
  while (!bytes.empty()) {
    const auto progress = parser.feed(bytes);
    bytes = bytes.subspan(progress.consumed);
    if (progress.event == Event::kScan) {
      const RawScan& scan = parser.scan();
      heard.scans.emplace_back(scan.range_mm.begin(),
                               scan.range_mm.begin() + static_cast<std::ptrdiff_t>(scan.points));
      heard.times.push_back(scan.time_ms);
    }
    if (progress.event == Event::kReply) {
      std::string reply = std::string(parser.reply().echo()) + "|" + std::string(parser.reply().status());
      for (std::size_t i = 0; i < parser.reply().lines(); ++i)
        reply += "|" + std::string(parser.reply().line(i));
      heard.replies.push_back(reply);
    }
    if (progress.event == Event::kGarbage) ++heard.garbage;
  }
}

Heard parse(std::string_view text) {
  ScipParser parser;
  Heard heard;
  feed(parser, text, heard);
  return heard;
}

TEST(ScipParser, ReadsThePublishedMdScan) {
  const Heard heard = parse("MD0540054401000\n99b\n4]J7B\n0?X0CB1Dh?om0015\n\n");
  ASSERT_EQ(heard.scans.size(), 1U);
  EXPECT_THAT(heard.scans[0], ElementsAre(1000, 1234, 5432, 65533, 1));
  EXPECT_EQ(heard.times[0], 1234567U);
  EXPECT_EQ(heard.garbage, 0);
}

TEST(ScipParser, ReadsThePublishedMeScan) {
  const std::string text = "ME0540054201000\n99b\n4]J7B\n0?X0O@0CB0GL1Dh0>4m\n\n";
  ScipParser parser;
  const auto progress = parser.feed(std::as_bytes(std::span(text)));
  ASSERT_EQ(progress.event, Event::kScan);
  EXPECT_EQ(progress.consumed, text.size());
  const RawScan& scan = parser.scan();
  ASSERT_EQ(scan.points, 3U);
  EXPECT_THAT((std::vector{scan.range_mm[0], scan.range_mm[1], scan.range_mm[2]}),
              ElementsAre(1000, 1234, 5432));
  EXPECT_THAT((std::vector{scan.intensity[0], scan.intensity[1], scan.intensity[2]}),
              ElementsAre(2000, 1500, 900));
}

TEST(ScipParser, TakesTheFirstEchoOfThePublishedNdScan) {
  const Heard heard = parse("ND0540054201000\n99b\n4]J7B\n0?X&0GL0O@0W4&0XX&0Z<L\n\n");
  ASSERT_EQ(heard.scans.size(), 1U);
  EXPECT_THAT(heard.scans[0], ElementsAre(1000, 2000, 2500));
}

TEST(ScipParser, ReadsNeAndTwoCharacterScans) {
  const std::string pair1 = number(700, 3) + number(10, 3), pair2 = number(800, 3) + number(20, 3);
  const Heard ne = parse(scan_text("NE0000000101000", 5, pair1 + "&" + pair2 + pair2));
  ASSERT_EQ(ne.scans.size(), 1U);
  EXPECT_THAT(ne.scans[0], ElementsAre(700, 800));
  const Heard ms = parse(scan_text("MS0000000101000", 5, number(1234, 2) + number(4095, 2)));
  ASSERT_EQ(ms.scans.size(), 1U);
  EXPECT_THAT(ms.scans[0], ElementsAre(1234, 4095));
}

TEST(ScipParser, ReadsPublishedReplies) {
  EXPECT_THAT(parse("TM1\n00P\nooool\n\n").replies, ElementsAre("TM1|00|ooool"));
  EXPECT_THAT(parse("QT\n00P\n\n").replies, ElementsAre("QT|00"));
  EXPECT_THAT(parse("SCIP2.0\n0\n\n").replies, ElementsAre("SCIP2.0|0"));
  EXPECT_THAT(parse("PP\n00P\nDMIN:23;7\nDMAX:60000;J\n\n").replies,
              ElementsAre("PP|00|DMIN:23;7|DMAX:60000;J"));
}

TEST(ScipParser, ValuesStraddleLinesAndTheLastLineMayBeFull) {
  for (const std::size_t points : {21U, 22U, 64U, 682U, 1081U, 1440U}) {
    std::vector<std::uint32_t> values(points);
    for (std::size_t i = 0; i < points; ++i) values[i] = static_cast<std::uint32_t>(i * 181 % 262144);
    const std::string echo =
        "MD0000" + std::string(points <= 1000 ? "0" : "") + std::to_string(points - 1) + "01000";
    std::string end = std::to_string(points - 1);
    end.insert(0, 4 - end.size(), '0');
    const Heard heard = parse(scan_text("MD0000" + end + "01000", 1, ranges(values)));
    ASSERT_EQ(heard.scans.size(), 1U) << points;
    EXPECT_EQ(heard.scans[0], values);
  }
}

TEST(ScipParser, RefusesScansOfTheWrongLength) {
  EXPECT_EQ(parse(scan_text("MD0000000401000", 1, ranges({1, 2, 3, 4}))).garbage, 1);
  EXPECT_EQ(parse(scan_text("MD0000000401000", 1, ranges({1, 2, 3, 4, 5, 6}))).garbage, 1);
  EXPECT_EQ(parse(scan_text("MD0000000401000", 1, ranges({1, 2, 3, 4, 5}) + "0")).garbage, 1);
  EXPECT_EQ(parse(scan_text("MD0004000001000", 1, ranges({1}))).garbage, 1);
  // More values than a Scan holds: refused before anything is stored.
  EXPECT_EQ(parse(scan_text("MD0000999901000", 1, ranges(std::vector<std::uint32_t>(10000, 7)))).garbage, 1);
}

TEST(ScipParser, ShortLineInTheMiddleIsRefused) {
  const std::string data = ranges(std::vector<std::uint32_t>(30, 1234));
  const std::string text = "MD0000002901000\n99b\n" + with_sum(number(1, 4)) + with_sum(data.substr(0, 60)) +
                           with_sum(data.substr(60)) + "\n";
  EXPECT_TRUE(parse(text).scans.empty());
}

TEST(ScipParser, DropsOneScanOnABadChecksumAndTakesTheNext) {
  const std::string good = scan_text("MD0000002901000", 7, ranges(std::vector<std::uint32_t>(30, 4321)));
  std::string bad = good;
  bad[40] = bad[40] == '0' ? '1' : '0';
  const Heard heard = parse(good + bad + good);
  EXPECT_EQ(heard.scans.size(), 2U);
  EXPECT_EQ(heard.garbage, 1);
}

TEST(ScipParser, SurvivesALineWithoutEnd) {
  ScipParser parser;
  Heard heard;
  for (int i = 0; i < 1000; ++i) feed(parser, std::string(997, 'A'), heard);
  feed(parser, "\n\nQT\n00P\n\n", heard);
  EXPECT_THAT(heard.replies, ElementsAre("QT|00"));
  EXPECT_EQ(heard.garbage, 1);
}

TEST(ScipParser, RefusesAReplyWithTooManyLines) {
  std::string text = "VV\n00P\n";
  for (int i = 0; i < 40; ++i) text += "X:1;0\n";
  EXPECT_TRUE(parse(text + "\n").replies.empty());
  std::string fat = "VV\n00P\n";
  for (int i = 0; i < 12; ++i) fat += std::string(150, 'x') + "\n";
  EXPECT_TRUE(parse(fat + "\n").replies.empty());
}

std::string sample_stream() {
  std::string text = reply_text("QT", "00") + reply_text("MD0000108001000", "00");
  for (std::uint32_t k = 0; k < 3; ++k) {
    std::vector<std::uint32_t> values(1081);
    for (std::uint32_t i = 0; i < 1081; ++i) values[i] = (i * 37 + k * 1000) % 60000;
    text += scan_text("MD0000108001000", 25 * k, ranges(values));
  }
  text += "ND0540054201000\n99b\n4]J7B\n0?X&0GL0O@0W4&0XX&0Z<L\n\n";
  return text;
}

TEST(ScipParserProperty, AnySplitGivesTheSame) {
  const std::string text = sample_stream();
  const Heard whole = parse(text);
  ASSERT_EQ(whole.scans.size(), 4U);
  EXPECT_TRUE(rc::check([&] {
    ScipParser parser;
    Heard heard;
    for (std::size_t i = 0; i < text.size();) {
      const auto size = *rc::gen::weightedOneOf<std::size_t>(
          {{3, rc::gen::inRange<std::size_t>(1, 5)}, {2, rc::gen::inRange<std::size_t>(1, 3000)}});
      feed(parser, std::string_view(text).substr(i, size), heard);
      i += size;
    }
    RC_ASSERT(heard == whole);
  }));
}

/// One changed byte is always noticed: within the alphabet the six check bits tell all values apart,
/// outside it the character itself does. Only an echo has no check: there the values must be the same still.
TEST(ScipParserProperty, OneWrongByteNeverChangesAValueAndTheParserRecovers) {
  const std::string text = sample_stream();
  const Heard whole = parse(text);
  EXPECT_TRUE(rc::check([&] {
    std::string bad = text;
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    bad[at] = static_cast<char>(static_cast<unsigned char>(bad[at]) ^ *rc::gen::inRange<unsigned>(1, 256));
    const Heard heard = parse(bad + text);
    for (const auto& scan : heard.scans) {
      RC_ASSERT(std::find(whole.scans.begin(), whole.scans.end(), scan) != whole.scans.end());
    }
    // Every scan of the clean second half is there; at most the first reply of it goes down with the damage.
    RC_ASSERT(heard.scans.size() >= 2 * whole.scans.size() - 2);
    RC_ASSERT(std::equal(whole.scans.rbegin(), whole.scans.rend(), heard.scans.rbegin()));
  }));
}

TEST(ScipParserProperty, EveryPossibleWrongByteOfASmallScanIsNoticed) {
  std::vector<std::uint32_t> values(30);
  for (std::uint32_t i = 0; i < 30; ++i) values[i] = i * 8111 % 262144;
  const std::string good = scan_text("MD0000002901000", 1234567, ranges(values));
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (unsigned change = 1; change < 256; ++change) {
      std::string bad = good;
      bad[at] = static_cast<char>(static_cast<unsigned char>(bad[at]) ^ change);
      const Heard heard = parse(bad + good + good);
      ASSERT_FALSE(heard.scans.empty());
      for (std::size_t i = 0; i < heard.scans.size(); ++i) {
        ASSERT_EQ(heard.scans[i], values) << at << " " << change;
        ASSERT_EQ(heard.times[i], 1234567U) << at << " " << change;
      }
    }
  }
}

/// Bursts of damage, lost and added bytes: six check bits a line cannot catch everything, but length, echo
/// and line structure hold, and what comes after is understood.
TEST(ScipParserProperty, RecoversFromAnyDamage) {
  const std::string text = sample_stream();
  const Heard whole = parse(text);
  EXPECT_TRUE(rc::check([&] {
    std::string bad = text;
    const int hits = *rc::gen::inRange(1, 20);
    for (int i = 0; i < hits; ++i) {
      const auto at = *rc::gen::inRange<std::size_t>(0, bad.size());
      switch (*rc::gen::inRange(0, 3)) {
        case 0:
          bad.erase(at, *rc::gen::inRange<std::size_t>(1, 200));
          break;
        case 1:
          bad.insert(at, *rc::gen::arbitrary<std::string>());
          break;
        default:
          bad[at] = *rc::gen::arbitrary<char>();
          break;
      }
      if (bad.empty()) break;
    }
    ScipParser parser;
    Heard heard;
    feed(parser, bad + "\n\n", heard);
    Heard after;
    feed(parser, text, after);
    RC_ASSERT(std::equal(whole.scans.rbegin(), whole.scans.rend() - 1, after.scans.rbegin()));
  }));
}

}  // namespace
}  // namespace topo::hokuyo

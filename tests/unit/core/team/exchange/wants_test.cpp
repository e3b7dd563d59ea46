// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/wants.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/team/exchange/wire.hpp"
#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::item_of;
using testing::kFrames;
using Holds = std::map<StreamKey, StreamSummary>;

Holds holding(const StreamKey& key, std::uint32_t items) { return {{key, {key, items, items, items, {}}}}; }

auto wanted(const ItemStore& store, std::span<const Source> sources, const CapParams& caps = {}) {
  return find_wants({9, 1}, store, Assemblies(1'000'000), sources, caps);
}

TEST(Wants, AreReadAsWritten) {
  EXPECT_TRUE(rc::check([] {
    WantList list{{4, 5}, 77, {}};
    StreamWants& wants = list.streams.emplace_back();
    wants.key = kFrames;
    wants.covered = *rc::gen::inRange<std::uint32_t>(0, 1'000);
    std::uint32_t next = 0;
    const int runs = *rc::gen::inRange(1, 60);
    for (int i = 0; i < runs; ++i) {
      next += *rc::gen::inRange<std::uint32_t>(1, 300);
      const bool whole = *rc::gen::arbitrary<bool>();
      const auto count = whole ? *rc::gen::inRange<std::uint32_t>(1, 50) : 1U;
      wants.runs.push_back({next, count, whole ? kAllPieces : *rc::gen::inRange<PieceBits>(1, 63)});
      next += count;
    }
    const auto read = decode_wants(encode_wants(list));
    RC_ASSERT(read.has_value());
    RC_ASSERT(read->to == list.to);
    RC_ASSERT(read->heard == list.heard);
    RC_ASSERT(read->streams == list.streams);
  }));
}

TEST(Wants, ALongListIsCutAndCoversWhatItNames) {
  WantList list{{4, 5}, 1, {}};
  StreamWants& wants = list.streams.emplace_back();
  wants.key = kFrames;
  wants.covered = 5'000;
  for (std::uint32_t i = 0; i < 1'000; ++i) wants.runs.push_back({i * 3, 1, 0x5});
  const auto body = encode_wants(list);
  EXPECT_LE(body.size(), kBodyBytesMax);
  const auto read = decode_wants(body);
  ASSERT_TRUE(read);
  ASSERT_FALSE(read->streams.empty());
  EXPECT_LT(read->streams[0].runs.size(), 1'000U);
  EXPECT_EQ(read->streams[0].covered, read->streams[0].runs.back().first + 1);
}

TEST(Wants, HostileRunsAreRefused) {
  types::ByteWriter out;
  write_origin(out, {1, 1});
  out.integer(std::uint32_t{0});
  write_stream(out, kFrames);
  out.varint(0);
  out.varint(1);
  out.varint(1);                  // from 0, whole
  out.varint(~std::uint64_t{0});  // and as many as there are
  EXPECT_FALSE(decode_wants(out.bytes()));
}

TEST(Wants, NothingIsWantedThatIsHeldOrThatNobodyHas) {
  ItemStore store;
  for (const std::uint32_t n : {0U, 1U, 4U}) store.insert({kFrames, n}, item_of({1}));
  const Holds theirs = holding(kFrames, 6);
  const std::vector<Source> sources{{{2, 1}, &theirs}};
  const auto wants = wanted(store, sources);
  ASSERT_EQ(wants.size(), 1U);
  const StreamWants& stream = wants.at({2, 1}).front();
  EXPECT_EQ(stream.runs, (std::vector<WantRun>{{2, 2, kAllPieces}, {5, 1, kAllPieces}}));
  EXPECT_GE(stream.covered, 6U);
}

TEST(Wants, TheOriginIsAskedBeforeOthers) {
  const Holds theirs = holding(kFrames, 40);
  const std::vector<Source> sources{{{1, 1}, &theirs}, {{2, 1}, &theirs}};
  const auto wants = wanted({}, sources);
  EXPECT_TRUE(wants.contains({1, 1}));
  EXPECT_FALSE(wants.contains({2, 1}));
}

TEST(Wants, OthersShareTheWorkWithoutOverlap) {
  const Holds theirs = holding(kFrames, 120);
  const std::vector<Source> sources{{{2, 1}, &theirs}, {{3, 1}, &theirs}};
  CapParams caps;
  caps.oldest_wanted = 120;
  const auto wants = wanted({}, sources, caps);
  std::vector<int> asked(120, 0);
  for (const auto& [peer, streams] : wants) {
    for (const WantRun& run : streams.front().runs) {
      for (std::uint32_t i = 0; i < run.count; ++i) ++asked.at(run.first + i);
    }
    EXPECT_EQ(streams.front().covered, 0U) << "what is not named may be wanted from another";
  }
  EXPECT_EQ(wants.size(), 2U);
  EXPECT_EQ(asked, std::vector<int>(120, 1));
}

TEST(Wants, OldestAndNewestAreWantedWithinTheirBounds) {
  const Holds theirs = holding(kFrames, 1'000);
  const std::vector<Source> sources{{{1, 1}, &theirs}};
  CapParams caps;
  caps.oldest_wanted = 10;
  caps.newest_wanted = 4;
  const StreamWants stream = wanted({}, sources, caps).at({1, 1}).front();
  EXPECT_EQ(stream.runs, (std::vector<WantRun>{{0, 10, kAllPieces}, {996, 4, kAllPieces}}));
  EXPECT_EQ(stream.covered, 10U);
}

TEST(Wants, OfABegunKeyframeOnlyWhatIsMissing) {
  Assemblies assemblies(100'000);
  const std::vector<std::byte> item(3'000);
  assemblies.add(head_of({kFrames, 0}, item, 1), piece_of(item, 1));
  const Holds theirs = holding(kFrames, 1);
  const std::vector<Source> sources{{{1, 1}, &theirs}};
  const auto wants = find_wants({9, 1}, {}, assemblies, sources, {});
  EXPECT_EQ(wants.at({1, 1}).front().runs, (std::vector<WantRun>{{0, 1, 0b101}}));
}

TEST(Wants, NothingOfThisRunIsWantedFromOthers) {
  const StreamKey own{ItemKind::kKeyframe, {9, 1}};
  const Holds theirs = holding(own, 5);
  const std::vector<Source> sources{{{2, 1}, &theirs}};
  EXPECT_TRUE(wanted({}, sources).empty());
}

}  // namespace
}  // namespace topo::team

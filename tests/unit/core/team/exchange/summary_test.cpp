// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/summary.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/team/exchange/wire.hpp"
#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::item_of;

ItemStore store_with(const std::vector<std::uint32_t>& numbers) {
  ItemStore store;
  for (const std::uint32_t number : numbers)
    store.insert({{ItemKind::kRelation, {3, 70'000}}, number}, item_of({1}));
  return store;
}

TEST(Summary, SaysWhatIsHeldWithinItsBits) {
  EXPECT_TRUE(rc::check([] {
    const auto numbers =
        *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::inRange<std::uint32_t>(0, 400));
    const ItemStore store = store_with(numbers);
    const auto bodies = encode_summaries(store);
    RC_ASSERT(bodies.size() == 1U);
    const auto summary = decode_summary(bodies.front());
    RC_ASSERT(summary.has_value());
    RC_ASSERT(summary->hash == store.hash());
    RC_ASSERT(summary->items == store.size());
    if (numbers.empty()) return;
    const StreamSummary& stream = summary->streams.front();
    const ItemStream& held = store.streams().begin()->second;
    RC_ASSERT(stream.count == held.items().size());
    RC_ASSERT(stream.end == held.end());
    for (std::uint32_t number = 0; number < 420; ++number) {
      const bool told = number <= stream.first_gap + kSummaryBits;
      RC_ASSERT(stream.holds(number) == (told && held.contains(number)));
    }
  }));
}

TEST(Summary, ManyStreamsTakeSeveralMessages) {
  ItemStore store;
  for (std::uint16_t robot = 0; robot < 300; ++robot)
    store.insert({{ItemKind::kLog, {robot, 0xFFFF'0000U}}, 0}, item_of({1}));
  std::size_t streams = 0;
  const auto bodies = encode_summaries(store);
  EXPECT_GT(bodies.size(), 1U);
  for (const auto& body : bodies) {
    EXPECT_LE(body.size(), kBodyBytesMax);
    const auto summary = decode_summary(body);
    ASSERT_TRUE(summary);
    streams += summary->streams.size();
  }
  EXPECT_EQ(streams, 300U);
}

TEST(Summary, CutOffBytesAreNone) {
  const auto body = encode_summaries(store_with({0, 1, 5, 9})).front();
  for (std::size_t size = 10; size < body.size(); ++size)
    EXPECT_FALSE(decode_summary(std::span(body).first(size))) << size;
}

TEST(Summary, NumbersBeyondTheBoundAreRefused) {
  types::ByteWriter out;
  out.integer(std::uint64_t{1});
  out.varint(1);
  write_stream(out, {ItemKind::kLog, {1, 1}});
  out.varint(kNumbersMax + 1);
  out.varint(0);
  EXPECT_FALSE(decode_summary(out.bytes()));
}

}  // namespace
}  // namespace topo::team

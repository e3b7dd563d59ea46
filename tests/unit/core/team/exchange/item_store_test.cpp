// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/team/exchange/item_store.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <set>

#include "tests/unit/core/team/exchange/exchange_fixture.hpp"

namespace topo::team {
namespace {

using testing::item_of;

const StreamKey kStream{ItemKind::kLog, {1, 2}};

TEST(ItemStore, TheFirstGapClosesWithWhatWasLacking) {
  ItemStore store;
  EXPECT_EQ(store.insert({kStream, 1}, item_of({1})), Stored::kNew);
  EXPECT_EQ(store.insert({kStream, 3}, item_of({3})), Stored::kNew);
  EXPECT_EQ(store.stream(kStream)->first_gap(), 0U);
  store.insert({kStream, 0}, item_of({0}));
  EXPECT_EQ(store.stream(kStream)->first_gap(), 2U);
  EXPECT_EQ(store.stream(kStream)->end(), 4U);
  store.insert({kStream, 2}, item_of({2}));
  EXPECT_EQ(store.stream(kStream)->first_gap(), 4U);
  EXPECT_EQ(store.size(), 4U);
  EXPECT_EQ(store.bytes(), 4U);
}

TEST(ItemStore, OfTwoUnderOneKeyTheLowerIsKept) {
  ItemStore a, b;
  a.insert({kStream, 0}, item_of({1, 9}));
  EXPECT_EQ(a.insert({kStream, 0}, item_of({1, 9})), Stored::kHeld);
  EXPECT_EQ(a.insert({kStream, 0}, item_of({2})), Stored::kKept);
  EXPECT_EQ(a.insert({kStream, 0}, item_of({1, 2})), Stored::kReplaced);
  b.insert({kStream, 0}, item_of({1, 2}));
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_EQ(a.bytes(), b.bytes());
}

TEST(ItemStore, WhatIsNotHeldIsNull) {
  ItemStore store;
  EXPECT_EQ(store.find({kStream, 0}), nullptr);
  EXPECT_EQ(store.stream(kStream), nullptr);
  EXPECT_FALSE(store.contains({kStream, 0}));
}

TEST(ItemStore, TheHashIsOfTheSetAndOfNoOrder) {
  EXPECT_TRUE(rc::check([] {
    auto keys = *rc::gen::container<std::vector<std::pair<int, int>>>(
        rc::gen::pair(rc::gen::inRange(0, 3), rc::gen::inRange(0, 20)));
    const auto fill = [](const auto& list) {
      ItemStore store;
      for (const auto& [robot, number] : list) {
        const ItemKey key{{ItemKind::kKeyframe, {static_cast<std::uint16_t>(robot), 1}},
                          static_cast<std::uint32_t>(number)};
        store.insert(key, item_of({robot, number}));
      }
      return store;
    };
    const ItemStore one = fill(keys);
    std::reverse(keys.begin(), keys.end());
    const ItemStore other = fill(keys);
    RC_ASSERT(one.hash() == other.hash());
    RC_ASSERT(one.size() == other.size());
    if (!keys.empty()) {
      const auto lost = keys.front();
      std::erase(keys, lost);
      RC_ASSERT(fill(keys).hash() != one.hash());
    }
  }));
}

TEST(ItemStore, BytesOfAnyLengthHaveTheirHash) {
  std::set<std::uint64_t> hashes;
  for (std::size_t size = 0; size < 40; ++size) hashes.insert(hash_of(std::vector<std::byte>(size)));
  EXPECT_EQ(hashes.size(), 40U) << "zeros of different lengths differ";
}

}  // namespace
}  // namespace topo::team

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/turn_queues.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace topo::places {
namespace {

TEST(Rising, GivesTheLowestThatIsLeftAndTakesMoreMeanwhile) {
  EXPECT_TRUE(rc::check([] {
    Rising cells;
    for (int round = 0; round < 3; ++round) {
      std::multiset<std::uint32_t> left;
      const auto add = [&] {
        const auto cell = *rc::gen::inRange<std::uint32_t>(0, 50);
        cells.add(cell);
        left.insert(cell);
      };
      for (int k = *rc::gen::inRange(0, 20); k > 0; --k) add();
      cells.start();
      int more = *rc::gen::inRange(0, 20);
      for (std::uint32_t cell = 0; cells.next(cell);) {
        RC_ASSERT(!left.empty() && cell == *left.begin());
        left.erase(left.begin());
        for (; more > 0 && *rc::gen::inRange(0, 2) == 0; --more) add();
      }
      RC_ASSERT(left.empty());
    }
  }));
}

TEST(Rising, OfNothingIsEmptyAgainAndAgain) {
  Rising cells;
  std::uint32_t cell = 7;
  for (int round = 0; round < 2; ++round) {
    cells.start();
    EXPECT_FALSE(cells.next(cell));
    EXPECT_EQ(cell, 7U);
  }
}

TEST(Buckets, GiveTheCellsOfEachAndEndAfterTheLast) {
  EXPECT_TRUE(rc::check([] {
    Buckets buckets;
    for (int round = 0; round < 2; ++round) {
      std::map<std::size_t, std::vector<std::uint32_t>> cells;
      for (std::uint32_t cell = 0; cell < 30; ++cell) {
        if (*rc::gen::inRange(0, 2) == 0) continue;
        const auto bucket = *rc::gen::element<std::size_t>(0, 1, 5, 70, kBuckets - 1);
        buckets.add(cell, bucket);
        cells[bucket].push_back(cell);
      }
      RC_ASSERT(buckets.end() == (cells.empty() ? 0 : cells.rbegin()->first + 1));
      for (std::size_t bucket = 0; bucket < buckets.end(); ++bucket) {
        Rising taken;
        buckets.take(bucket, taken);
        taken.start();
        std::vector<std::uint32_t> found;
        for (std::uint32_t cell = 0; taken.next(cell);) found.push_back(cell);
        RC_ASSERT(found == cells[bucket]);
        Rising nothing;
        buckets.take(bucket, nothing);
        nothing.start();
        std::uint32_t cell = 0;
        RC_ASSERT(!nothing.next(cell));
      }
      buckets.clear();
      RC_ASSERT(buckets.end() == 0U);
    }
  }));
}

}  // namespace
}  // namespace topo::places

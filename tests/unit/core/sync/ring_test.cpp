// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/sync/ring.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <deque>

namespace topo::sync {
namespace {

TEST(Ring, IsEmptyAtFirst) {
  Ring<int, 4> ring;
  EXPECT_EQ(ring.front(), nullptr);
  EXPECT_EQ(ring.size(), 0U);
  EXPECT_EQ(ring.skip_to_newest(), 0U);
  EXPECT_EQ(ring.front(), nullptr);
}

TEST(Ring, GivesTheSameSlotUntilItIsCommitted) {
  Ring<int, 4> ring;
  int* slot = ring.try_acquire();
  ASSERT_NE(slot, nullptr);
  *slot = 7;
  EXPECT_EQ(ring.try_acquire(), slot);
  EXPECT_EQ(ring.front(), nullptr);
  ring.commit();
  EXPECT_NE(ring.try_acquire(), slot);
  ASSERT_EQ(ring.front(), slot);  // in place: no copy between
  EXPECT_EQ(*ring.front(), 7);
}

TEST(Ring, RejectsWhenFullAndCounts) {
  Ring<int, 4> ring;
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ring.try_push(i));
  EXPECT_FALSE(ring.try_push(4));
  EXPECT_EQ(ring.try_acquire(), nullptr);
  EXPECT_EQ(ring.rejected(), 2U);
  EXPECT_EQ(*ring.front(), 0);
  ring.pop();
  EXPECT_TRUE(ring.try_push(5));
  EXPECT_EQ(ring.committed(), 5U);
}

TEST(Ring, CountsNoValueThatMayStillNotCome) {
  Ring<int, 2> ring;
  int* slot = ring.next_free();
  ASSERT_NE(slot, nullptr);
  EXPECT_EQ(ring.try_acquire(), slot);
  EXPECT_TRUE(ring.try_push(0) && ring.try_push(1));
  EXPECT_EQ(ring.next_free(), nullptr);
  EXPECT_EQ(ring.rejected(), 0U);
  ring.reject();
  EXPECT_EQ(ring.rejected(), 1U);
}

TEST(Ring, SkipsToTheNewestAndCounts) {
  Ring<int, 8> ring;
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(ring.try_push(i));
  EXPECT_EQ(ring.skip_to_newest(), 5U);
  EXPECT_EQ(*ring.front(), 5);
  EXPECT_EQ(ring.skip_to_newest(), 0U);
  ring.pop();
  EXPECT_EQ(ring.front(), nullptr);
  EXPECT_EQ(ring.skipped(), 5U);
  EXPECT_EQ(ring.size(), 0U);
}

TEST(Ring, DoesWhatABoundedQueueDoes) {
  EXPECT_TRUE(rc::check([] {
    Ring<int, 4> ring;
    std::deque<int> model;
    std::uint64_t rejected = 0;
    std::uint64_t skipped = 0;
    int next = 0;
    for (const int action : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 7))) {
      if (action < 4) {
        if (ring.try_push(next)) {
          model.push_back(next);
        } else {
          RC_ASSERT(model.size() == 4U);
          ++rejected;
        }
        ++next;
      } else if (action < 6 && !model.empty()) {
        ring.pop();
        model.pop_front();
      } else if (action == 6 && !model.empty()) {
        skipped += model.size() - 1;
        RC_ASSERT(ring.skip_to_newest() == model.size() - 1);
        model.erase(model.begin(), model.end() - 1);
      }
      RC_ASSERT(ring.size() == model.size());
      const int* front = ring.front();
      RC_ASSERT((front == nullptr) == model.empty());
      if (front != nullptr) RC_ASSERT(*front == model.front());
      RC_ASSERT(ring.rejected() == rejected);
      RC_ASSERT(ring.skipped() == skipped);
    }
  }));
}

}  // namespace
}  // namespace topo::sync

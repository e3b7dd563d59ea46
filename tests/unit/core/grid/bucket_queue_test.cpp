// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/bucket_queue.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <limits>

namespace topo::grid {
namespace {

constexpr float kStepMin_m = 0.05F;
constexpr float kStepMax_m = 0.5F;
constexpr float kEnd = std::numeric_limits<float>::infinity();

TEST(BucketQueue, GivesAllInTheOrderOfTheirCostToWithinABucket) {
  EXPECT_TRUE(rc::check([] {
    BucketQueue queue;
    queue.reset(kStepMin_m, kStepMax_m);
    const auto costs_mm = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 500));
    for (std::size_t i = 0; i < costs_mm.size(); ++i) {
      queue.push(static_cast<std::uint32_t>(i), static_cast<float>(costs_mm[i]) * 1e-3F);
    }
    std::vector<std::uint32_t> seen;
    float before_m = 0.0F;
    RC_ASSERT(queue.drain(kEnd, [&](BucketQueue::Entry entry) {
      RC_ASSERT(entry.cost_m > before_m - kStepMin_m);
      before_m = std::max(before_m, entry.cost_m);
      seen.push_back(entry.index);
    }));
    std::sort(seen.begin(), seen.end());
    RC_ASSERT(seen.size() == costs_mm.size());
    for (std::size_t i = 0; i < seen.size(); ++i) RC_ASSERT(seen[i] == i);
  }));
}

TEST(BucketQueue, ItemsPushedWhileDrainingKeepTheirOrder) {
  EXPECT_TRUE(rc::check([] {
    // A chain: each entry pushes the next one a step dearer, round the ring several times.
    const int steps = *rc::gen::inRange(1, 200);
    const float step_m = static_cast<float>(*rc::gen::inRange(50, 501)) * 1e-3F;
    const float pause_m = static_cast<float>(*rc::gen::inRange(0, 2000)) * 1e-2F;
    BucketQueue queue;
    queue.reset(kStepMin_m, kStepMax_m);
    queue.push(0, 0.0F);
    int next = 0;
    const auto follow = [&](BucketQueue::Entry entry) {
      RC_ASSERT(entry.index == static_cast<std::uint32_t>(next));
      if (++next < steps) queue.push(entry.index + 1, entry.cost_m + step_m);
    };
    const bool done = queue.drain(pause_m, follow);
    RC_ASSERT(!done || next == steps);
    RC_ASSERT(queue.next_m() >= std::min(pause_m, static_cast<float>(next - 1) * step_m) - kStepMin_m);
    RC_ASSERT(queue.drain(kEnd, follow));
    RC_ASSERT(next == steps);
  }));
}

TEST(BucketQueue, NothingIsLeftOfTheLastSearch) {
  BucketQueue queue;
  queue.reset(kStepMin_m, kStepMax_m);
  queue.push(7, 0.3F);
  queue.reset(kStepMin_m, kStepMax_m);
  EXPECT_TRUE(queue.drain(kEnd, [](BucketQueue::Entry) { ADD_FAILURE() << "an entry of the last search"; }));
}

}  // namespace
}  // namespace topo::grid

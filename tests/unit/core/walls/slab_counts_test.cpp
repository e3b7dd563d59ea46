// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/walls/slab_counts.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

namespace topo::walls {
namespace {

TEST(SlabCounts, WhatIsTakenBackLeavesWhatOthersSaw) {
  EXPECT_TRUE(rc::check("any columns, any of them taken back, in any order", [] {
    const auto stay = *rc::gen::container<std::vector<Slabs>>(rc::gen::arbitrary<Slabs>());
    const auto leave = *rc::gen::container<std::vector<Slabs>>(rc::gen::arbitrary<Slabs>());
    SlabCounts counts;
    Slabs expected = 0;
    for (const Slabs slabs : leave) counts.add(slabs);
    for (const Slabs slabs : stay) {
      counts.add(slabs);
      expected |= slabs;
    }
    for (const Slabs slabs : leave) counts.remove(slabs);
    RC_ASSERT(counts.seen() == expected);
  }));
}

TEST(SlabCounts, CountsAsFarAsItSays) {
  SlabCounts counts;
  constexpr int kMost = 65535;
  for (int i = 0; i < kMost; ++i) counts.add(5U);
  EXPECT_EQ(counts.seen(), 5U);
  for (int i = 0; i < kMost - 1; ++i) counts.remove(5U);
  EXPECT_EQ(counts.seen(), 5U);
  counts.remove(4U);
  EXPECT_EQ(counts.seen(), 1U);
}

}  // namespace
}  // namespace topo::walls

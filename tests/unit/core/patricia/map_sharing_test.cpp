// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What versions share, and what an update therefore costs: counted, not timed.
#include <gtest/gtest.h>

#include "tests/unit/core/patricia/model.hpp"

namespace topo::patricia {
namespace {

using namespace testing;

BitMap square(BitArena& arena, std::int32_t side) {
  BitMap map(arena);
  for (std::int32_t x = 0; x < side; ++x) {
    for (std::int32_t y = 0; y < side; ++y) map.insert(cell_key(x, y), 1);
  }
  return map;
}

TEST(Sharing, ASnapshotCostsNoNode) {
  BitArena arena;
  const BitMap map = square(arena, 64);
  const auto before = arena.counts();
  const BitMap snapshot = map;
  EXPECT_TRUE(snapshot.same_version(map));
  EXPECT_EQ(arena.counts().leaves, before.leaves);
  EXPECT_EQ(arena.counts().branches, before.branches);
}

TEST(Sharing, ABatchCopiesANodeOnce) {
  BitArena arena;
  BitMap map = square(arena, 64);  // 4096 keys, 12 branches deep
  const BitMap snapshot = map;
  map.insert(cell_key(5, 5), 2);
  EXPECT_EQ(arena.counts().leaves, 4096U + 1U);
  EXPECT_EQ(arena.counts().branches, 4095U + 12U);
  map.insert(cell_key(5, 5), 3);  // nobody else has this path any more
  EXPECT_EQ(arena.counts().leaves, 4096U + 1U);
  EXPECT_EQ(arena.counts().branches, 4095U + 12U);
  for (std::int32_t x = 0; x < 8; ++x) {
    for (std::int32_t y = 0; y < 8; ++y) map.insert(cell_key(x, y), 4);
  }
  EXPECT_EQ(arena.counts().leaves, 4096U + 64U);
  EXPECT_EQ(arena.counts().branches, 4095U + 63U + 6U);  // the whole block's, and the way to it
  EXPECT_EQ(*snapshot.find(cell_key(5, 5)), 1U);
}

TEST(Sharing, WithoutASnapshotNothingIsCopied) {
  BitArena arena;
  BitMap map = square(arena, 16);
  const Bits* where = map.find(cell_key(3, 3));
  map.insert(cell_key(3, 3), 9);
  map.update(cell_key(3, 3)) += 1;
  EXPECT_EQ(map.find(cell_key(3, 3)), where);
  EXPECT_EQ(*where, 10U);
}

TEST(Sharing, SeeingAThingTwiceCopiesNothing) {
  BitArena arena;
  BitMap map = square(arena, 16);
  const BitMap snapshot = map;
  map.insert_with(cell_key(3, 3), 1, kUnion);
  EXPECT_TRUE(map.same_version(snapshot));
}

TEST(Sharing, ErasingAMissingKeyCopiesNothing) {
  BitArena arena;
  BitMap map = square(arena, 16);
  const BitMap snapshot = map;
  EXPECT_FALSE(map.erase(cell_key(-1, 3)));
  EXPECT_TRUE(map.same_version(snapshot));
}

// The finger remembers which nodes are shared; what changes that behind its back must make it forget.

TEST(Finger, ForgetsWhenASnapshotIsDropped) {
  BitArena arena;
  BitMap map = square(arena, 16);
  BitMap snapshot = map;
  map.insert_with(cell_key(3, 3), 1, kUnion);  // changes nothing: the way stays shared
  snapshot.clear();
  map.insert(cell_key(3, 3), 2);
  map.insert(cell_key(3, 2), 2);
  EXPECT_EQ(arena.counts().leaves, 256U);
  EXPECT_EQ(arena.counts().branches, 255U);
}

TEST(Finger, ForgetsWhenAMergeSharesTheInnerNodes) {
  BitArena arena;
  BitMap map = square(arena, 16);
  BitMap other(arena);
  other.insert(cell_key(15, 15), 8);
  map.insert(cell_key(3, 3), 2);  // the finger is here, and all is exclusive
  const BitMap both = BitMap::merge(map, other, kUnion);
  map.insert(cell_key(3, 3), 4);
  EXPECT_EQ(*both.find(cell_key(3, 3)), 2U);
  EXPECT_EQ(*map.find(cell_key(3, 3)), 4U);
}

TEST(Finger, DoesNotTakeOneTreeForAnotherUnderTheSameHandle) {
  BitArena arena;
  BitMap map = square(arena, 16);
  BitMap other = square(arena, 8);
  map.insert(cell_key(3, 3), 2);
  map.swap(other);
  map.insert(cell_key(3, 3), 4);
  EXPECT_EQ(map.size(), 64U);
  EXPECT_EQ(*map.find(cell_key(3, 3)), 4U);
  EXPECT_EQ(*other.find(cell_key(3, 3)), 2U);
}

/// Counts comparisons, which difference makes for leaves that it could not skip by the pointer.
struct Counted {
  static inline int comparisons = 0;
  int value = 0;
  friend bool operator==(const Counted& a, const Counted& b) {
    ++comparisons;
    return a.value == b.value;
  }
};

TEST(Sharing, DifferenceLooksOnlyAtWhatChanged) {
  Arena<Counted> arena;
  Map<Counted> map(arena);
  for (std::int32_t i = 0; i < 10000; ++i) map.insert(cell_key(i % 100, i / 100), Counted{i});
  const Map<Counted> before = map;
  map.insert(cell_key(17, 4), Counted{-1});
  map.erase(cell_key(80, 90));
  Counted::comparisons = 0;
  int reported = 0;
  Map<Counted>::difference(before, map, [&](Key, const Counted*, const Counted*) { ++reported; });
  EXPECT_EQ(reported, 2);
  EXPECT_LE(Counted::comparisons, 2);
}

TEST(Sharing, MergeThatKeepsSharedSubtreesCombinesOnlyWhatDiffers) {
  BitArena arena;
  const BitMap base = square(arena, 64);
  BitMap a = base;
  BitMap b = base;
  a.insert(cell_key(1, 1), 2);
  b.insert(cell_key(1, 1), 4);
  b.insert(cell_key(70, 70), 8);
  int combined = 0;
  const auto counting_union = [&](const Bits& x, const Bits& y) {
    ++combined;
    return x | y;
  };
  const BitMap both = BitMap::merge(a, b, counting_union, SharedSubtrees::kKeep);
  EXPECT_EQ(combined, 1);
  EXPECT_EQ(both.size(), 64U * 64U + 1U);
  EXPECT_EQ(*both.find(cell_key(1, 1)), 6U);
}

}  // namespace
}  // namespace topo::patricia

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/patricia/arena.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <thread>

#include "core/patricia/map.hpp"
#include "tests/unit/core/patricia/model.hpp"

namespace topo::patricia {
namespace {

using namespace testing;

TEST(Arena, UsesAgainWhatWasFreed) {
  BitArena arena;
  BitMap map(arena);
  for (Key key = 0; key < 5000; ++key) map.insert(key, 1);
  const std::size_t reserved = arena.counts().bytes_reserved;
  for (int round = 0; round < 3; ++round) {
    map.clear();
    for (Key key = 0; key < 5000; ++key) map.insert(key * 977, 1);
  }
  EXPECT_EQ(arena.counts().bytes_reserved, reserved);
}

TEST(Arena, TakesAbout48BytesAKeyOf32Bits) {
  BitArena arena;
  BitMap map(arena);
  for (Key key = 0; key < 100000; ++key) map.insert(key, 1);
  EXPECT_LT(arena.counts().bytes_reserved, 100000U * 64U);
  EXPECT_GE(arena.counts().bytes_reserved, 100000U * 48U - 32U);
}

TEST(Arena, DestroysValuesWithTheLastVersionThatHasThem) {
  Arena<std::shared_ptr<int>> arena;
  const auto value = std::make_shared<int>(1);
  {
    Map<std::shared_ptr<int>> map(arena);
    map.insert(1, value);
    std::optional<Map<std::shared_ptr<int>>> old = map;
    map.erase(1);
    EXPECT_EQ(value.use_count(), 2);
    old.reset();
    EXPECT_EQ(value.use_count(), 1);
    map.insert(2, value);
    map.update(2) = nullptr;
    EXPECT_EQ(value.use_count(), 1);
    map.insert(3, value);
  }
  EXPECT_EQ(value.use_count(), 1);
  EXPECT_EQ(arena.counts().leaves, 0U);
}

TEST(Arena, DropsTheDeepestTreeAndALargeOne) {
  BitArena arena;
  BitMap deepest(arena);
  deepest.insert(0, 1);
  for (unsigned bit = 0; bit < 64; ++bit) deepest.insert(Key{1} << bit, 1);
  EXPECT_EQ(deepest.size(), 65U);
  for (unsigned bit = 0; bit < 64; ++bit) EXPECT_NE(deepest.find(Key{1} << bit), nullptr);
  const BitMap snapshot = deepest;
  deepest.update(0) = 2;
  EXPECT_EQ(*snapshot.find(0), 1U);
  deepest.clear();

  BitMap large(arena);
  for (Key key = 0; key < 300000; ++key) large.insert(key, 1);
  large.clear();
  EXPECT_EQ(arena.counts().leaves, 65U);
}

TEST(Arena, GoesToAThreadThatAdoptsIt) {
  BitArena arena;
  BitMap map(arena);
  map.insert(1, 1);
  std::thread([&] {
    arena.adopt();
    map.insert(2, 2);
  }).join();
  arena.adopt();
  map.insert(3, 3);
  EXPECT_EQ(map.size(), 3U);
}

TEST(Arena, ReadingNeedsNoOwner) {
  BitArena arena;
  BitMap map(arena);
  map.insert(1, 1);
  std::size_t seen = 0;
  std::thread([&] {
    map.for_each([&](Key, Bits) { ++seen; });
    if (map.find(1) != nullptr) ++seen;
    BitMap::difference(BitMap(), map, [&](Key, const Bits*, const Bits*) { ++seen; });
  }).join();
  EXPECT_EQ(seen, 3U);
}

class ArenaDeathTest : public ::testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }

  template <class F>
  static void elsewhere(F f) {
    std::thread(f).join();
  }
  BitArena arena_;
  BitMap map_{arena_};
};

TEST_F(ArenaDeathTest, AbortsWhenAnotherThreadBuilds) {
  map_.insert(1, 1);
  EXPECT_DEATH(elsewhere([&] { map_.insert(2, 2); }), "not the arena's owner");
  EXPECT_DEATH(elsewhere([&] { map_.update(1) = 2; }), "not the arena's owner");
  EXPECT_DEATH(elsewhere([&] { map_.erase(1); }), "not the arena's owner");
  EXPECT_DEATH(elsewhere([&] { map_.clear(); }), "not the arena's owner");
}

TEST_F(ArenaDeathTest, AbortsWhenAnotherThreadCopiesOrMerges) {
  map_.insert(1, 1);
  EXPECT_DEATH(elsewhere([&] { const BitMap copy = map_; }), "not the arena's owner");
  EXPECT_DEATH(elsewhere([&] { (void)BitMap::merge(map_, map_, kUnion); }), "not the arena's owner");
}

TEST_F(ArenaDeathTest, AbortsWhenItGoesBeforeItsMaps) {
  EXPECT_DEATH(
      {
        auto arena = std::make_unique<BitArena>();
        BitMap map(*arena);
        map.insert(1, 1);
        arena.reset();
      },
      "before its maps");
}

TEST_F(ArenaDeathTest, AbortsWhenMapsOfTwoArenasMeet) {
  BitArena other_arena;
  BitMap other(other_arena);
  other.insert(1, 1);
  map_.insert(1, 1);
  EXPECT_DEATH((void)BitMap::merge(map_, other, kUnion), "two arenas");
}

}  // namespace
}  // namespace topo::patricia

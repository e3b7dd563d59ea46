// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/numbered.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

namespace topo::slam {
namespace {

using Things = std::map<KeyframeId, int>;

/// Things of a few origins with gaps; each has a value of its own.
Things random_things(std::mt19937& random) {
  Things things;
  const std::size_t count = random() % 40;
  while (things.size() < count) {
    const KeyframeId id{static_cast<std::uint16_t>(random() % 3), static_cast<std::uint32_t>(random() % 9),
                        static_cast<std::uint32_t>(random() % 2)};
    things.emplace(id, static_cast<int>(things.size()));
  }
  return things;
}

/// The number from which on one who has these counts may lack something.
std::uint32_t first_unknown(const Origin& origin, std::span<const OriginCount> there) {
  for (const OriginCount& count : there)
    if (Origin{count.robot, count.run} == origin) return count.next;
  return 0;
}

TEST(CountsOf, AreTheFirstNumbersThatAreNotThere) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const Things things = random_things(random);
    std::vector<OriginCount> expected;
    for (std::uint16_t robot = 0; robot < 3; ++robot) {
      for (std::uint32_t run = 0; run < 2; ++run) {
        const bool has_any = std::ranges::any_of(things, [&](const auto& entry) {
          return entry.first.origin() == Origin{robot, run};
        });
        std::uint32_t next = 0;
        while (things.contains({robot, next, run})) ++next;
        if (has_any) expected.push_back({robot, next, run});
      }
    }
    EXPECT_EQ(counts_of(things), expected) << seed;
  }
}

TEST(MissingOf, IsWhatLiesAtOrBeyondTheCounts) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const Things here = random_things(random);
    std::vector<OriginCount> there = counts_of(random_things(random));
    std::shuffle(there.begin(), there.end(), random);
    std::vector<int> expected;
    for (const auto& [id, thing] : here)
      if (id.sequence >= first_unknown(id.origin(), there)) expected.push_back(thing);
    EXPECT_EQ(missing_of(here, there, 1000), expected) << seed;
    for (const std::size_t most : {0U, 1U, 2U, 5U, 17U}) {
      std::vector<int> first = expected;
      first.resize(std::min(first.size(), most));
      EXPECT_EQ(missing_of(here, there, most), first) << seed;
    }
  }
}

TEST(MissingOf, NothingIsMissingWhereAllIs) {
  Things things;
  for (std::uint32_t i = 0; i < 5; ++i) things[{1, i, 0}] = things[{1, i, 3}] = 0;
  EXPECT_TRUE(missing_of(things, counts_of(things), 100).empty());
  EXPECT_TRUE(missing_of(Things{}, counts_of(things), 100).empty());
  EXPECT_TRUE(counts_of(Things{}).empty());
}

}  // namespace
}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/elimination.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "tests/unit/core/slam/graph_fixture.hpp"

namespace topo::slam {
namespace {

using Links = std::vector<Elimination::Link>;

/// Random links, some of them twice, some the other way round, some from a variable to itself.
Links jumbled_links(std::size_t variables, std::size_t count, std::mt19937& random) {
  Links links;
  for (std::size_t k = 0; variables > 0 && k < count; ++k) {
    const std::size_t a = random() % variables, b = random() % variables;
    links.emplace_back(a, b);
    if (random() % 4 == 0) links.emplace_back(b, a);
  }
  return links;
}

/// Rows of every column of the factor, by playing the elimination game on a full matrix: who is eliminated
/// ties all that are left beside it.
std::vector<std::set<std::size_t>> game_columns(const Elimination& elimination, const Links& links) {
  const std::size_t size = elimination.variables();
  std::vector<std::set<std::size_t>> columns(size);
  for (std::size_t j = 0; j < size; ++j) columns[j].insert(j);
  for (const auto& [a, b] : links) {
    const auto [low, high] = std::minmax({elimination.rank(a), elimination.rank(b)});
    columns[low].insert(high);
  }
  for (std::size_t j = 0; j < size; ++j) {
    for (const std::size_t a : columns[j]) {
      for (const std::size_t b : columns[j])
        if (a > j && b > a) columns[a].insert(b);
    }
  }
  return columns;
}

TEST(Elimination, PatternIsThatOfTheEliminationGame) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const std::size_t size = 1 + random() % 30;
    const Links links = jumbled_links(size, random() % 80, random);
    const Elimination elimination(size, links);
    const auto columns = game_columns(elimination, links);
    std::size_t blocks = 0;
    for (std::size_t j = 0; j < size; ++j) {
      std::vector<std::size_t> rows;
      for (std::size_t p = elimination.begin(j); p < elimination.begin(j + 1); ++p)
        rows.push_back(elimination.row(p));
      EXPECT_EQ(rows, std::vector(columns[j].begin(), columns[j].end())) << seed << ": column " << j;
      EXPECT_EQ(elimination.begin(j), blocks);
      blocks += rows.size();
    }
    EXPECT_EQ(elimination.blocks(), blocks);
  }
}

TEST(Elimination, EveryVariableHasARankOfItsOwn) {
  for (const std::size_t size : {1U, 2U, 17U, 200U}) {
    std::mt19937 random(static_cast<unsigned>(size));
    const Elimination elimination(size, jumbled_links(size, 3 * size, random));
    std::vector<std::size_t> ranks, all(size);
    for (std::size_t v = 0; v < size; ++v) ranks.push_back(elimination.rank(v));
    std::sort(ranks.begin(), ranks.end());
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(ranks, all);
  }
}

TEST(Elimination, ALinkHasOnePlaceFromEitherSide) {
  std::mt19937 random(5);
  const std::size_t size = 40;
  const Links links = jumbled_links(size, 90, random);
  const Elimination elimination(size, links);
  for (const auto& [a, b] : links) {
    const Elimination::Place one = elimination.place(a, b), other = elimination.place(b, a);
    const auto [low, high] = std::minmax({elimination.rank(a), elimination.rank(b)});
    EXPECT_EQ(one.index, other.index);
    EXPECT_EQ(one.transposed != other.transposed, a != b);
    EXPECT_EQ(one.transposed, elimination.rank(a) < elimination.rank(b));
    EXPECT_GE(one.index, elimination.begin(low));
    EXPECT_LT(one.index, elimination.begin(low + 1));
    EXPECT_EQ(elimination.row(one.index), high);
  }
  for (std::size_t v = 0; v < size; ++v)
    EXPECT_EQ(elimination.place(v, v).index, elimination.begin(elimination.rank(v)));
}

TEST(Elimination, AStarIsFactorisedWithoutFill) {
  for (const std::size_t size : {2U, 10U, 30U, 300U}) {
    Links star;  // whose centre would fill everything if it went first
    for (std::size_t i = 1; i < size; ++i) star.emplace_back(0, i);
    EXPECT_EQ(Elimination(size, star).blocks(), 2 * size - 1);
  }
}

/// From the leaves on a tree has no fill; degrees are approximate, so that there is a little.
TEST(Elimination, ATreeHasLittleFill) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const std::size_t size = 2 + random() % 200;
    const std::size_t blocks = Elimination(size, testing::random_ties(size, 0, random)).blocks();
    EXPECT_GE(blocks, 2 * size - 1) << seed;
    EXPECT_LE(blocks, 2 * size - 1 + size / 4) << seed;
  }
}

TEST(Elimination, ARingHasTheFillOfAnyOrder) {
  for (const std::size_t size : {3U, 4U, 5U, 50U}) {
    Links ring;
    for (std::size_t i = 0; i < size; ++i) ring.emplace_back(i, (i + 1) % size);
    // Every variable but the last two that are eliminated has two neighbours then.
    EXPECT_EQ(Elimination(size, ring).blocks(), size + 2 * (size - 2) + 1);
  }
}

TEST(Elimination, WithoutLinksThereIsNothingButTheDiagonal) {
  const Elimination none(0, {}), five(5, {});
  EXPECT_EQ(none.variables(), 0U);
  EXPECT_EQ(none.blocks(), 0U);
  EXPECT_EQ(five.blocks(), 5U);
  for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(five.row(five.begin(j)), j);
}

}  // namespace
}  // namespace topo::slam

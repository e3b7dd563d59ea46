// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/replace_part.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace topo::compass {
namespace {

using Numbers = std::vector<int>;

Numbers with_part(const Numbers& others) {
  Numbers all{1, 2, 3, 4, 5};
  replace_part(all, all.begin() + 1, all.begin() + 3, others);
  return all;
}

TEST(ReplacePart, PutsAsManyOrFewerOrMoreInItsPlace) {
  EXPECT_EQ(with_part({7, 8}), (Numbers{1, 7, 8, 4, 5}));
  EXPECT_EQ(with_part({7}), (Numbers{1, 7, 4, 5}));
  EXPECT_EQ(with_part({}), (Numbers{1, 4, 5}));
  EXPECT_EQ(with_part({7, 8, 9, 10}), (Numbers{1, 7, 8, 9, 10, 4, 5}));
}

TEST(ReplacePart, OfNothingIsAll) {
  Numbers all;
  replace_part(all, all.begin(), all.end(), {1, 2});
  EXPECT_EQ(all, (Numbers{1, 2}));
}

TEST(ReplacePart, OfAnyLengthAnywhereIsThePartsInARow) {
  std::mt19937 random(1);
  for (int k = 0; k < 300; ++k) {
    Numbers all(random() % 12), others(random() % 12);
    std::iota(all.begin(), all.end(), 0);
    std::iota(others.begin(), others.end(), 100);
    const std::size_t first = random() % (all.size() + 1), length = random() % (all.size() - first + 1);
    const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(i); };
    Numbers expected(all.begin(), at(first));
    expected.insert(expected.end(), others.begin(), others.end());
    expected.insert(expected.end(), at(first + length), all.end());
    replace_part(all, at(first), at(first + length), others);
    EXPECT_EQ(all, expected) << first << " " << length;
  }
}

}  // namespace
}  // namespace topo::compass

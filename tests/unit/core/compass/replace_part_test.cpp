// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/compass/replace_part.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace topo::compass

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/carmen/passed_over.hpp"

#include <gtest/gtest.h>

namespace topo::bench {
namespace {

TEST(PassedOver, CountsByWordInTheOrderOfTheFile) {
  PassedOver lines;
  EXPECT_EQ(lines.count(), 0);
  lines.add(3, "b");
  lines.add(4, "a");
  lines.add(9, "b");
  EXPECT_EQ(lines.remark("such"), "passed over 3 lines such: 2 of b (the first in line 3), 1 of a (line 4)");
}

TEST(PassedOver, NamesFiveWordsAndShortOnes) {
  PassedOver lines;
  lines.add(1, std::string(100, 'x') + "\n\x01");
  EXPECT_EQ(lines.named(), "1 of " + std::string(40, 'x') + " (line 1)");
  for (int i = 0; i < 2000; ++i) lines.add(2 + i, std::to_string(i));
  EXPECT_EQ(lines.count(), 2001);
  EXPECT_TRUE(lines.named().ends_with("1 of 3 (line 5), and others")) << lines.named();
}

}  // namespace
}  // namespace topo::bench

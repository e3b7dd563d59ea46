// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/invariant.hpp"

#include <gtest/gtest.h>

#include "core/types/scan.hpp"

namespace topo::types {
namespace {

TEST(InvariantDeathTest, ABrokenOneAbortsAndIsNamed) {
  EXPECT_DEATH(require(false, "here: the bound"), "broken invariant: here: the bound");
}

TEST(Invariant, OneThatHoldsDoesNothing) {
  int after = 0;
  require(true, "never written");
  EXPECT_EQ(++after, 1);
}

TEST(InvariantDeathTest, AScanHoldsNoMoreBeamsThanItsArrays) {
  static Scan scan;
  scan.beams = Scan::kMaxBeams;
  EXPECT_EQ(scan.checked_beams(), Scan::kMaxBeams);
  EXPECT_EQ(scan.ranges().size(), Scan::kMaxBeams);
  scan.beams = Scan::kMaxBeams + 1;
  EXPECT_DEATH((void)scan.checked_beams(), "more beams");
  EXPECT_DEATH((void)scan.ranges(), "more beams");
}

}  // namespace
}  // namespace topo::types

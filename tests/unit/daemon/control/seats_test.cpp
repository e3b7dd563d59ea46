// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/seats.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace topo::daemon {
namespace {

constexpr Seats kSeats{.commanding = 2, .others = 4, .of_one_other = 3};
constexpr Standing kInGroup{true, 1}, kA{false, 2}, kB{false, 3}, kC{false, 4};

std::optional<std::size_t> leaves(const std::vector<Standing>& present, const Standing& newcomer) {
  return who_leaves(present, newcomer, kSeats);
}

TEST(Seats, NobodyLeavesWhileThereIsRoom) {
  EXPECT_FALSE(leaves({}, kA));
  EXPECT_FALSE(leaves({kA, kA, kInGroup}, kB));
  EXPECT_FALSE(leaves({kA, kA, kA, kB, kInGroup}, kInGroup));
}

TEST(Seats, CommandersLeaveForCommandersOnly) {
  EXPECT_EQ(leaves({kA, kInGroup, kInGroup, kB}, kInGroup), 1U);
  EXPECT_EQ(leaves({kInGroup, kInGroup, kA, kA, kB, kB}, kC), 2U);
}

TEST(Seats, AUserDisplacesHimself) { EXPECT_EQ(leaves({kB, kA, kA, kA}, kA), 1U); }

TEST(Seats, WhoHasMostMakesRoomForAnother) {
  EXPECT_EQ(leaves({kB, kA, kA, kA}, kC), 1U);
  EXPECT_EQ(leaves({kB, kA, kA, kB}, kC), 0U);
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/control/token_bucket.hpp"

#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

TEST(TokenBucket, BurstThenTheRate) {
  TokenBucket bucket(100ms, 3);
  types::Stamp now{10s};
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(bucket.take(now)) << i;
  EXPECT_FALSE(bucket.take(now));
  EXPECT_EQ(bucket.next_at(now), now + 100ms);
  EXPECT_FALSE(bucket.take(now + 99ms));
  EXPECT_TRUE(bucket.take(now + 100ms));
  EXPECT_FALSE(bucket.take(now + 100ms));
}

TEST(TokenBucket, FillsUpToTheBurstAndNoFurther) {
  TokenBucket bucket(100ms, 3);
  types::Stamp now{10s};
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(bucket.take(now));
  EXPECT_FALSE(bucket.is_full(now + 299ms));
  EXPECT_TRUE(bucket.is_full(now + 300ms));
  now += 1h;
  int taken = 0;
  while (bucket.take(now)) ++taken;
  EXPECT_EQ(taken, 3);
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/watchdog.hpp"

#include <gtest/gtest.h>

namespace topo::types {
namespace {

using std::chrono::milliseconds;

TEST(Watchdog, IsSafeUpToTwoSeconds) {
  EXPECT_TRUE(is_watchdog_safe(milliseconds(1)));
  EXPECT_TRUE(is_watchdog_safe(milliseconds(2000)));
  EXPECT_FALSE(is_watchdog_safe(milliseconds(2001)));
  EXPECT_FALSE(is_watchdog_safe(Duration{}));
  EXPECT_FALSE(is_watchdog_safe(milliseconds(-1)));
}

}  // namespace
}  // namespace topo::types

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/types/battery.hpp"

#include <gtest/gtest.h>

namespace topo::types {
namespace {

constexpr BatteryLimits kLimits{11.6, 0.2};

TEST(Battery, IsLowBelowEitherLimit) {
  EXPECT_FALSE(is_battery_low(12.0F, 0.5F, kLimits));
  EXPECT_TRUE(is_battery_low(11.5F, 0.5F, kLimits));
  EXPECT_TRUE(is_battery_low(12.0F, 0.1F, kLimits));
  EXPECT_TRUE(is_battery_low(12.0F, 0.0F, kLimits)) << "empty, and reported";
}

TEST(Battery, WhatIsNotReportedIsNotLow) {
  EXPECT_FALSE(is_battery_low(0.0F, -1.0F, kLimits));
  EXPECT_FALSE(is_battery_low(12.0F, -1.0F, kLimits));
  EXPECT_TRUE(is_battery_low(0.0F, 0.1F, kLimits));
}

}  // namespace
}  // namespace topo::types

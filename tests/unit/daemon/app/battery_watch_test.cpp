// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/battery_watch.hpp"

#include <gtest/gtest.h>

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

/// Notes a reading a second; how often it was told.
int told_in(BatteryWatch& watch, int& second, int seconds_more, bool low) {
  int told = 0;
  for (const int end = second + seconds_more; second < end; ++second)
    told += watch.note(low, types::Stamp{1s * second}) ? 1 : 0;
  return told;
}

TEST(BatteryWatch, TellsOnceWhatStaysLow) {
  BatteryWatch watch;
  int second = 100;
  EXPECT_EQ(told_in(watch, second, 5, false), 0);
  EXPECT_EQ(told_in(watch, second, 9, true), 0) << "a motor that starts";
  EXPECT_EQ(told_in(watch, second, 1, false), 0);
  EXPECT_EQ(told_in(watch, second, 10, true), 0);
  EXPECT_EQ(told_in(watch, second, 1, true), 1);
  EXPECT_EQ(told_in(watch, second, 600, true), 0);
}

TEST(BatteryWatch, TellsItAgainAfterItWasChargedNotAfterItWasSpared) {
  BatteryWatch watch;
  int second = 0;
  EXPECT_EQ(told_in(watch, second, 20, true), 1);
  EXPECT_EQ(told_in(watch, second, 30, false) + told_in(watch, second, 20, true), 0);
  EXPECT_EQ(told_in(watch, second, 61, false) + told_in(watch, second, 20, true), 1);
}

}  // namespace
}  // namespace topo::daemon

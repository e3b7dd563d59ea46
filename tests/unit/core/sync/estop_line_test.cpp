// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/sync/estop_line.hpp"

#include <gtest/gtest.h>

namespace topo::sync {
namespace {

TEST(EStopLine, ReadsNothingBeforeAnybodyActs) {
  EStopLine<> line;
  const auto reading = line.read();
  EXPECT_FALSE(reading.pressed);
  EXPECT_FALSE(reading.cleared);
  EXPECT_FALSE(line.pressed());
}

TEST(EStopLine, StaysPressedUntilItIsCleared) {
  EStopLine<> line;
  line.press();
  for (int period = 0; period < 3; ++period) {
    const auto reading = line.read();
    EXPECT_TRUE(reading.pressed);
    EXPECT_FALSE(reading.cleared);
  }
  line.clear();
  EXPECT_FALSE(line.pressed());
}

TEST(EStopLine, AClearIsReadOnce) {
  EStopLine<> line;
  line.press();
  line.clear();
  line.clear();
  EXPECT_TRUE(line.read().cleared);
  EXPECT_FALSE(line.read().cleared);
}

TEST(EStopLine, APressAfterAClearIsReadWithIt) {
  EStopLine<> line;
  line.press();
  line.clear();
  line.press();
  const auto reading = line.read();
  EXPECT_TRUE(reading.pressed);
  EXPECT_TRUE(reading.cleared);
}

}  // namespace
}  // namespace topo::sync

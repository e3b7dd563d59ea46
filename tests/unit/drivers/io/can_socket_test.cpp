// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What needs no bus; the rest is tested where there is one (tests/vm/can_test.py).
#include "drivers/io/can_socket.hpp"

#include <gtest/gtest.h>

namespace topo::io {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(CanArrival, AnOldFrameIsNeverAFreshOne) {
  const types::Stamp now{seconds(5000)};
  EXPECT_EQ(can_arrival(now, milliseconds(3)), now - milliseconds(3));
  EXPECT_EQ(can_arrival(now, seconds(1)), now - seconds(1));
  EXPECT_EQ(can_arrival(now, milliseconds(1001)), now - seconds(1));
  EXPECT_EQ(can_arrival(now, seconds(3600)), now - seconds(1));
  EXPECT_EQ(can_arrival(now, -milliseconds(1)), now);  // the clock was set back
}

}  // namespace
}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/yielding.hpp"

#include <gtest/gtest.h>

#include <array>

namespace topo::motion {
namespace {

using std::chrono::milliseconds;

struct Waiter {
  Yielding yielding;
  types::Stamp now = types::stamp_from_seconds(50.0);
  std::array<perception::MovingObstacle, 1> other{};
  void hold_up(double y_m, int periods) {
    other[0].centre = {1.0, y_m};
    for (int i = 0; i < periods; ++i) yielding.update(now += milliseconds(50), true, other);
  }
  void free(int periods) {
    for (int i = 0; i < periods; ++i) yielding.update(now += milliseconds(50), false, {});
  }
};

TEST(Yielding, WaitsWhileSomethingPassesButNotForEver) {
  Waiter w;
  EXPECT_FALSE(w.yielding.waits());
  w.hold_up(0.5, 180);
  EXPECT_TRUE(w.yielding.waits());
  w.hold_up(0.5, 40);
  EXPECT_FALSE(w.yielding.waits()) << "after ten seconds";
  w.free(10);
  w.hold_up(0.5, 10);
  EXPECT_FALSE(w.yielding.waits()) << "it is still the same one";
  w.free(80);
  w.hold_up(0.5, 1);
  EXPECT_TRUE(w.yielding.waits()) << "the next one";
}

TEST(Yielding, WhoHasTheOtherOnItsRightLetsItGoFirst) {
  Waiter left, right;
  left.hold_up(0.5, 20);
  right.hold_up(-0.5, 20);
  left.free(1);
  right.free(1);
  EXPECT_FALSE(left.yielding.lets_go_first());
  EXPECT_TRUE(right.yielding.lets_go_first());
  right.free(40);
  EXPECT_FALSE(right.yielding.lets_go_first()) << "two seconds later";
}

}  // namespace
}  // namespace topo::motion

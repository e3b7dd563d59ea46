// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/motion/yielding.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

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

TEST(Yielding, WaitsAsLongAsItsParametersSay) {
  YieldingParams params;
  params.patience = std::chrono::seconds(2);
  Yielding brief(params);
  const types::Stamp start = types::stamp_from_seconds(10.0);
  brief.update(start, true, {});
  EXPECT_TRUE(brief.waits());
  brief.update(start + params.patience, true, {});
  EXPECT_TRUE(brief.waits());
  brief.update(start + params.patience + std::chrono::milliseconds(50), true, {});
  EXPECT_FALSE(brief.waits());
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

/// Not held up for more than three seconds: another encounter.
TEST(Yielding, OfAnyCourseWaitsTenSecondsOfAnEncounterAtMost) {
  EXPECT_TRUE(rc::check([] {
    Waiter w;
    double begun_s = -100.0, last_s = -100.0, now_s = 0.0;  // of the encounter
    bool on_the_right = false;
    for (int phases = *rc::gen::inRange(1, 12); phases > 0; --phases) {
      const bool held_up = *rc::gen::arbitrary<bool>();
      const double y_m = *rc::gen::element(-0.5, 0.5);
      for (int periods = *rc::gen::inRange(1, 100); periods > 0; --periods) {
        held_up ? w.hold_up(y_m, 1) : w.free(1);
        now_s += 0.05;
        if (held_up) {
          if (now_s - last_s > 3.0 + 1e-9) begun_s = now_s;
          last_s = now_s;
          on_the_right = y_m < 0.0;
        }
        const bool patient = now_s - begun_s <= 10.0 + 1e-9;
        RC_ASSERT(w.yielding.waits() == (held_up && patient));
        const bool lets_go = !held_up && patient && on_the_right && now_s - last_s <= 1.5 + 1e-9;
        RC_ASSERT(w.yielding.lets_go_first() == lets_go);
      }
    }
  }));
}

TEST(Yielding, WhatIsNotSeenKeepsTheSideOfTheLastOne) {
  Waiter w;
  w.hold_up(-0.5, 5);
  for (int i = 0; i < 5; ++i) w.yielding.update(w.now += milliseconds(50), true, {});
  EXPECT_TRUE(w.yielding.waits());
  w.free(1);
  EXPECT_TRUE(w.yielding.lets_go_first());
}

}  // namespace
}  // namespace topo::motion

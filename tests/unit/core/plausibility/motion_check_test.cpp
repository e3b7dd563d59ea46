// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/plausibility/motion_check.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace topo::plausibility {
namespace {

types::Odometry odometry(double t_s, const types::Se2& pose, const types::Twist2& twist) {
  return {types::stamp_from_seconds(t_s), types::Transform2<types::Odom, types::Base>(pose), twist};
}

TEST(MotionCheck, believesEveryMotionOfTheModel) {
  EXPECT_TRUE(rc::check("an arc at a possible speed", [] {
    const auto unit = [] { return 1e-3 * *rc::gen::inRange(-1000, 1001); };
    const types::Twist2 a{1.2 * unit(), 4.0 * unit()};
    const double dt = 0.05 + 0.2 * std::abs(unit());
    const types::Se2 start{10.0 * unit(), 10.0 * unit(), 3.0 * unit()};
    const types::Se2 end = start * types::Se2{a.v_mps * dt, 0.0, a.omega_radps * dt};
    const types::Odometry before = odometry(1.0, start, a), now = odometry(1.0 + dt, end, a);
    RC_ASSERT(!is_impossible(&before, now, types::kP3dx, {}));
  }));
}

TEST(MotionCheck, refusesSpeedsBeyondTheModel) {
  for (const double v : {-6.1, 1.6, 30.0, std::nan("")})
    EXPECT_TRUE(is_impossible(nullptr, odometry(1.0, {}, {v, 0.0}), types::kP3dx, {})) << v;
  for (const double omega : {-7.0, 7.0, std::nan("")})
    EXPECT_TRUE(is_impossible(nullptr, odometry(1.0, {}, {0.0, omega}), types::kP3dx, {})) << omega;
  EXPECT_FALSE(is_impossible(nullptr, odometry(1.0, {}, {1.2, 5.0}), types::kP3dx, {}));
}

TEST(MotionCheck, refusesJumpsOfThePose) {
  const types::Odometry before = odometry(1.0, {2.0, 1.0, 0.3}, {0.5, 0.0});
  for (const types::Se2& jump :
       {types::Se2{0.5, 0.0, 0.0}, types::Se2{0.0, -0.4, 0.0}, types::Se2{0.0, 0.0, 0.8}}) {
    const types::Odometry now = odometry(1.1, before.T_odom_base.se2() * jump, {0.5, 0.0});
    EXPECT_TRUE(is_impossible(&before, now, types::kP3dx, {}));
  }
}

TEST(MotionCheck, aGapInTheStatusesIsNoJump) {
  const types::Odometry before = odometry(1.0, {}, {0.7, 0.0});
  EXPECT_FALSE(is_impossible(&before, odometry(1.4, {0.28, 0.0, 0.0}, {0.7, 0.0}), types::kP3dx, {}));
}

}  // namespace
}  // namespace topo::plausibility

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/forward_view.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <memory>

#include "core/perception/stop_zone.hpp"

namespace topo::daemon {
namespace {

using types::kDegree_rad;

TEST(ForwardView, SeenOfTheForwardSector) {
  const auto seen_deg = [](double yaw_deg, double view_deg = 270.0) {
    return seen_of_forward_sector_rad(yaw_deg * kDegree_rad, view_deg * kDegree_rad) / kDegree_rad;
  };
  for (const double yaw_deg : {0.0, 75.0, -75.0, 360.0})
    EXPECT_NEAR(seen_deg(yaw_deg), 120.0, 1e-9) << yaw_deg;
  EXPECT_NEAR(seen_deg(90.0), 105.0, 1e-9);
  EXPECT_NEAR(seen_deg(-90.0), 105.0, 1e-9);
  EXPECT_NEAR(seen_deg(180.0), 30.0, 1e-9);  // 15 degrees from either side
  EXPECT_NEAR(seen_deg(-180.0), 30.0, 1e-9);
  EXPECT_NEAR(seen_deg(60.0, 240.0), 120.0, 1e-9);  // a URG-04LX
  EXPECT_NEAR(seen_deg(70.0, 240.0), 110.0, 1e-9);
  EXPECT_NEAR(seen_deg(180.0, 360.0), 120.0, 1e-9);
  EXPECT_NEAR(seen_deg(180.0, 90.0), 0.0, 1e-9);
}

TEST(ForwardView, WhatIsAcceptedIsWhatIsPrintedAsRight) {
  EXPECT_EQ(forward_view_fault(0.0), "");
  EXPECT_EQ(forward_view_fault(1.308), "");
  EXPECT_EQ(forward_view_fault(-1.308), "");
  EXPECT_NE(forward_view_fault(1.31), "");
  EXPECT_NE(forward_view_fault(-1.31), "");
}

TEST(ForwardView, TheGreatestYawIsTheLastThatIsAccepted) {
  EXPECT_EQ(forward_view_fault(yaw_max_rad()), "");
  EXPECT_EQ(forward_view_fault(-yaw_max_rad()), "");
  EXPECT_NE(forward_view_fault(yaw_max_rad() + 1e-4), "");
}

/// The configuration's check and the gate judge by the same sector.
RC_GTEST_PROP(ForwardView, AgreesWithTheGatesShareOfBeams, ()) {
  const double yaw_rad = *rc::gen::inRange(-3150, 3151) * 1e-3;
  const auto scan = std::make_unique<types::Scan>();
  scan->beams = 1081;
  scan->geometry.angle_increment_rad = static_cast<float>(0.25 * kDegree_rad);
  scan->geometry.angle_min_rad = static_cast<float>(-135.0 * kDegree_rad);
  scan->range_m.fill(types::kNoReturn);
  const double share = perception::forward_valid_fraction(*scan, {0.0, 0.0, yaw_rad}, {});
  const double seen =
      seen_of_forward_sector_rad(yaw_rad) / (2.0 * perception::StopZoneParams{}.forward_sector_rad);
  RC_ASSERT(std::abs(share - seen) < 3.0 / 480.0);
}

}  // namespace
}  // namespace topo::daemon

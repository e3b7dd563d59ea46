// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/perceive.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace topo::pipeline {
namespace {

using std::chrono::milliseconds;
using types::Vector2;

/// A scanner 0.3 m ahead of the robot's middle that sees a wall 3 m away all around, and a map with a person
/// 0.3 m wide 1.2 m ahead of the scanner.
class SeenThrough : public ::testing::Test {
 protected:
  SeenThrough() {
    params_.T_base_laser = {0.3, 0.0, 0.0};
    scan_.beams = 271;
    scan_.geometry.angle_min_rad = -2.3562F;
    scan_.geometry.angle_increment_rad = 0.017453F;
    std::fill_n(scan_.range_m.begin(), scan_.beams, 3.0F);
    scan_.arrival = types::stamp_from_seconds(100.0);
    map_.box = {{-80, -80}, {79, 79}};
    map_.cells.assign(160UL * 160UL, grid::CellState::kFree);
    for (std::int32_t x = 30; x < 36; ++x)
      for (std::int32_t y = -3; y < 3; ++y) map_.cells[map_.index({x, y})] = grid::CellState::kOccupied;
    in_.now = scan_.arrival + milliseconds(50);
    in_.front = &scan_;
    in_.control = &control_;
  }
  [[nodiscard]] std::size_t cells() const { return seen_through(in_, place_, map_, {}, params_).size(); }

  PlannerParams params_;
  types::Scan scan_;
  grid::DenseMap map_;
  ControlReport control_;
  PlanningInput in_;
  Whereabouts place_;
};

TEST_F(SeenThrough, IsWhatTheScannerSeesFromWhereItIsMounted) {
  EXPECT_EQ(cells(), 36U);
  std::fill_n(scan_.range_m.begin(), scan_.beams, 1.5F);
  for (const Vector2& p : seen_through(in_, place_, map_, {}, params_)) EXPECT_LT(p.x(), 0.3 + 1.35);
  std::fill_n(scan_.range_m.begin(), scan_.beams, 1.3F);
  EXPECT_EQ(cells(), 0U) << "by the scanner's own distance of 1.2 m";
}

TEST_F(SeenThrough, IsNothingByAScanThatIsOldOrIsNotThere) {
  in_.now = scan_.arrival + params_.live_age_max;
  EXPECT_EQ(cells(), 36U);
  in_.now += milliseconds(1);
  EXPECT_EQ(cells(), 0U);
  in_.now = scan_.arrival;
  in_.front = nullptr;
  EXPECT_EQ(cells(), 0U);
}

TEST_F(SeenThrough, IsNothingWhileTheRobotTurns) {
  for (const double omega_radps : {0.5, -0.5}) {
    control_.odometry.twist.omega_radps = omega_radps;
    EXPECT_EQ(cells(), 0U);
  }
  control_.odometry.twist.omega_radps = 0.05;
  EXPECT_EQ(cells(), 36U);
}

}  // namespace
}  // namespace topo::pipeline

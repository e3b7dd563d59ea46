// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/closed_form.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace topo::calibration {
namespace {

constexpr double kModelTrack_m = 0.357, kCycle_s = 0.1;

/// What the firmware counts on a drive with the given speeds, a sample a cycle; fine steps in between.
template <class Speeds>
WheelTrack counted(const Speeds& speeds, double seconds) {
  std::vector<types::Odometry> odometry;
  types::Se2 pose;
  for (int i = 0; i * kCycle_s < seconds; ++i) {
    types::Odometry sample;
    sample.stamp = types::stamp_from_seconds(i * kCycle_s);
    sample.T_odom_base = types::Transform2<types::Odom, types::Base>(pose);
    odometry.push_back(sample);
    const types::Progress speed = speeds(i * kCycle_s);
    pose = pose * arc({speed.way_m * kCycle_s, speed.turn_rad * kCycle_s});
  }
  return {odometry, kModelTrack_m};
}

types::Progress winding(double t_s) { return {0.3 + 0.1 * std::sin(t_s), 0.8 * std::sin(0.3 * t_s)}; }
types::Progress straight(double) { return {0.3, 0.0}; }

std::vector<Interval> seen(const WheelTrack& wheels, const RobotNumbers& truth, double seconds) {
  const BasePath path(wheels, truth.wheels);
  std::vector<Interval> out;
  for (double t = 1.0; t + 3.0 < seconds; t += 1.0) {
    const auto from = path.at(t + truth.delay_s), to = path.at(t + 2.0 + truth.delay_s);
    if (!from || !to) continue;
    out.push_back({t, t + 2.0, (*from * truth.T_base_laser).inverse() * (*to * truth.T_base_laser)});
  }
  return out;
}

TEST(ClosedForm, FindsTheTruthWithoutNoise) {
  const RobotNumbers truth{{0.96, 1.04, 0.385}, {0.13, -0.04, 0.3}, 0.05};
  const WheelTrack wheels = counted(winding, 60.0);
  const auto intervals = seen(wheels, truth, 60.0);
  const auto found = closed_form(wheels, intervals, std::vector<bool>(intervals.size(), true), truth.delay_s);
  ASSERT_TRUE(found);
  EXPECT_LT((to_vector(*found) - to_vector(truth)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ClosedForm, LeavesOutWhatDoesNotCount) {
  const RobotNumbers truth{{1.0, 1.0, 0.357}, {0.1, 0.0, 0.0}, 0.0};
  const WheelTrack wheels = counted(winding, 60.0);
  auto intervals = seen(wheels, truth, 60.0);
  intervals[7].T_from_to.x_m += 0.5;
  std::vector<bool> use(intervals.size(), true);
  use[7] = false;
  const auto found = closed_form(wheels, intervals, use, 0.0);
  ASSERT_TRUE(found);
  EXPECT_LT((to_vector(*found) - to_vector(truth)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ClosedForm, HasNothingOfAStraightDrive) {
  const RobotNumbers truth{{1.0, 1.0, 0.357}, {0.1, 0.0, 0.0}, 0.0};
  const WheelTrack wheels = counted(straight, 60.0);
  const auto intervals = seen(wheels, truth, 60.0);
  EXPECT_FALSE(closed_form(wheels, intervals, std::vector<bool>(intervals.size(), true), 0.0));
}

TEST(ClosedForm, HasNothingOfNoIntervals) { EXPECT_FALSE(closed_form(counted(winding, 60.0), {}, {}, 0.0)); }

TEST(WheelTrack, CountsBackwardAndWholeTurns) {
  const WheelTrack track = counted([](double) { return types::Progress{-0.2, 0.9}; }, 20.05);
  const auto at = track.at(10.0);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->way_m, -2.0, 1e-9);
  EXPECT_NEAR(at->turn_rad, 9.0, 1e-9);
  EXPECT_FALSE(track.at(-0.1));
  EXPECT_FALSE(track.at(25.0));
}

TEST(WheelTrack, HasNothingAcrossAGap) {
  std::vector<types::Odometry> odometry(3);
  odometry[1].stamp = types::stamp_from_seconds(0.1);
  odometry[2].stamp = types::stamp_from_seconds(2.0);
  const WheelTrack track(odometry, kModelTrack_m);
  EXPECT_TRUE(track.at(0.05));
  EXPECT_FALSE(track.at(1.0));
}

}  // namespace
}  // namespace topo::calibration

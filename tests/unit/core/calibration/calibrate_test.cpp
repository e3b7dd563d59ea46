// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/calibration/calibrate.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/core/calibration/driven.hpp"

namespace topo::calibration {
namespace {

using types::kDegree_rad;

/// Of a drive by hand over three minutes, with the sensors' noise and the slips of the fixed difficulty.
void expect_within_the_bars(const Calibration& found, const Truth& truth) {
  ASSERT_TRUE(found.fit);
  EXPECT_TRUE(found.believable());
  const auto& got = found.fit->numbers;
  const types::Se2 off = truth.T_base_laser.inverse() * got.T_base_laser;
  EXPECT_NEAR(off.theta_rad, 0.0, 0.15 * kDegree_rad);
  EXPECT_LT(off.translation().norm(), 0.005);
  EXPECT_NEAR(got.wheels.left / truth.wheels.left, 1.0, 0.0015);
  EXPECT_NEAR(got.wheels.right / truth.wheels.right, 1.0, 0.0015);
  EXPECT_NEAR(got.wheels.track_m / truth.wheels.track_m, 1.0, 0.0025);
  EXPECT_NEAR(got.delay_s, truth.delay_s, 0.0025);
}

/// Every number is off by no more than its standard deviation says, and that says something.
void expect_honest_deviations(const Calibration& found, const Truth& truth) {
  ASSERT_TRUE(found.fit);
  const Vector off =
      to_vector(found.fit->numbers) - to_vector({truth.wheels, truth.T_base_laser, truth.delay_s});
  const Vector sigma = found.fit->covariance.diagonal().cwiseSqrt();
  for (int n = 0; n < kNumbers; ++n) EXPECT_LT(std::abs(off[n]), 3.5 * sigma[n]) << "number " << n;
  EXPECT_LT(sigma[kYaw], 0.1 * kDegree_rad);
  EXPECT_LT(sigma[kDelay], 0.001);
}

void expect_coronal(const Calibration& found, const Truth& truth) {
  ASSERT_TRUE(found.coronal);
  EXPECT_TRUE(found.coronal->has_floor && found.coronal->has_walls);
  EXPECT_NEAR(found.coronal->roll_rad, truth.coronal.roll_rad, 0.2 * kDegree_rad);
  EXPECT_NEAR(found.coronal->z_m, truth.coronal.z_m, 0.01);
  EXPECT_NEAR(found.coronal->x_m, truth.coronal.x_m, 0.01);
  EXPECT_NEAR(found.coronal->y_m, truth.coronal.y_m, 0.01);
}

class CalibrateSeeds : public testing::TestWithParam<std::uint64_t> {};

TEST_P(CalibrateSeeds, ThreeMinutesByHandMeetTheBars) {
  Truth truth;
  const DriveLog log = driven({}, GetParam(), truth);
  const Calibration found = calibrate(log, assumed(), {});
  expect_within_the_bars(found, truth);
  expect_honest_deviations(found, truth);
  expect_coronal(found, truth);
}

INSTANTIATE_TEST_SUITE_P(FiveOfThem, CalibrateSeeds, testing::Values(1, 2, 3, 4, 5));

/// Drives back and forth along one line.
class Shuttle final : public sim::WheelDrive {
 public:
  sim::WheelSpeeds wheel_speeds(sim::SimTime now, sim::SimTime, const sim::RobotBody&) override {
    const double v_mps = static_cast<int>(types::to_seconds(now) / 12.0) % 2 == 0 ? 0.3 : -0.3;
    return {v_mps, v_mps};
  }
};

/// Circles to the left for ever.
class Circle final : public sim::WheelDrive {
 public:
  sim::WheelSpeeds wheel_speeds(sim::SimTime, sim::SimTime, const sim::RobotBody&) override {
    return {0.2, 0.4};
  }
};

bool refuses(const Calibration& found, Doubt doubt) {
  return !found.believable() && std::any_of(found.refusals.begin(), found.refusals.end(),
                                            [=](const Refusal& r) { return r.doubt == doubt; });
}

/// For messages.
std::string said(const Calibration& found) {
  std::string text = found.believable() ? "believed" : "refused";
  for (const Refusal& r : found.refusals)
    text += " " + std::to_string(static_cast<int>(r.doubt)) + "(" + std::to_string(r.found) + ")";
  if (found.fit) text += ", spread " + std::to_string(found.fit->spread.place_m);
  return text;
}

Calibration calibrated(const Course& course) {
  Truth truth;
  return calibrate(driven(course, 1, truth), assumed(), {});
}

Course without_coronal() {
  Course course;
  course.coronal = false;
  return course;
}

TEST(Calibrate, RefusesAStraightDriveForItsTurns) {
  Shuttle shuttle;
  Course course = without_coronal();
  course.drive = &shuttle;
  course.difficulty.wheel_scale_error = course.difficulty.track_error = 0.0;
  course.seconds = 90.0;
  const Calibration found = calibrated(course);
  EXPECT_TRUE(refuses(found, Doubt::kNoTurnLeft));
  EXPECT_TRUE(refuses(found, Doubt::kNoTurnRight));
  EXPECT_FALSE(refuses(found, Doubt::kNoWay));
}

TEST(Calibrate, RefusesCirclesToOneSide) {
  Circle circle;
  Course course = without_coronal();
  course.drive = &circle;
  course.seconds = 90.0;
  const Calibration found = calibrated(course);
  EXPECT_TRUE(refuses(found, Doubt::kNoTurnRight));
  EXPECT_FALSE(refuses(found, Doubt::kNoTurnLeft));
}

TEST(Calibrate, RefusesAStandingRobotForItsWay) {
  Course course = without_coronal();
  course.seconds = 5.0;
  const Calibration found = calibrated(course);
  EXPECT_TRUE(refuses(found, Doubt::kShort));
  EXPECT_TRUE(refuses(found, Doubt::kNoWay));
}

TEST(Calibrate, RefusesAnEmptyLog) {
  EXPECT_TRUE(refuses(calibrate(DriveLog(0.357, 0.1), assumed(), {}), Doubt::kNoOdometry));
}

/// All that is near is glass, which lets most beams through into the open.
TEST(Calibrate, RefusesAGlassHall) {
  Course course = without_coronal();
  course.seconds = 65.0;
  course.world = R"(
[[start]]
x_m = 2.0
y_m = 1.5
[[glass]]
points_m = [[0.0, 0.0], [8.0, 0.0]]
transmission = 0.97
[[glass]]
points_m = [[8.0, 0.0], [8.0, 6.0]]
transmission = 0.97
[[glass]]
points_m = [[8.0, 6.0], [0.0, 6.0]]
transmission = 0.97
[[glass]]
points_m = [[0.0, 6.0], [0.0, 0.0]]
transmission = 0.97
[[wall]]
points_m = [[-60.0, -60.0], [60.0, -60.0], [60.0, 60.0], [-60.0, 60.0]]
closed = true
thickness_m = 0.2
)";
  const Calibration found = calibrated(course);
  EXPECT_TRUE(refuses(found, Doubt::kUnmatched) || refuses(found, Doubt::kDegenerate) ||
              refuses(found, Doubt::kPoorFit))
      << "matched " << found.evidence.matched << ", degenerate " << found.evidence.degenerate << ", response "
      << found.evidence.response;
}

TEST(Calibrate, RefusesAScannerBumpedOnTheWay) {
  for (const double at_s : {90.0, 140.0}) {
    Course course = without_coronal();
    course.spoil = [=](types::Scan& scan, double s) {
      if (s > at_s) scan.geometry.angle_min_rad += static_cast<float>(2.0 * kDegree_rad);
    };
    const Calibration found = calibrated(course);
    ASSERT_TRUE(refuses(found, Doubt::kMoved)) << at_s << " s: " << said(found);
    EXPECT_NEAR(std::abs(found.shift->yaw_rad), 2.0 * kDegree_rad, 1.2 * kDegree_rad);
  }
}

TEST(Calibrate, RefusesAMirroredScanner) {
  Course course = without_coronal();
  course.spoil = [](types::Scan& scan, double) {
    std::reverse(scan.range_m.begin(), scan.range_m.begin() + scan.beams);
  };
  EXPECT_TRUE(refuses(calibrated(course), Doubt::kAgainstWheels));
}

/// The robot that was calibrated needs nothing more: what was found is what was assumed.
TEST(Calibrate, FindsARightConfigurationRight) {
  Truth truth;
  truth.T_base_laser = {0.10, 0.0, 0.0};
  truth.delay_s = 0.0;
  Course course = without_coronal();
  course.difficulty.wheel_scale_error = course.difficulty.track_error = 0.0;
  const Calibration found = calibrate(driven(course, 7, truth), assumed(), {});
  expect_within_the_bars(found, truth);
  EXPECT_EQ(truth.wheels, (types::WheelCalibration{1.0, 1.0, truth.wheels.track_m}));
}

}  // namespace
}  // namespace topo::calibration

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/slam/doubt/beam_fan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace topo::slam {
namespace {

constexpr double kTolerance_m = 0.1;
const SurfacePoint kSurface{{10.0, 5.0}, {-1.0, 0.0}};  ///< a wall across the x axis, hit from the left

/// One beam from a laser at (x, 5), ahead of it, of that length; the robot looks to the left.
BeamFan fan(double x_m, double length_m, double off_rad = 0.0) {
  Keyframe keyframe;
  keyframe.sensor = Point(0.2F, 0.0F);
  const auto angle = static_cast<float>(off_rad - 0.5 * M_PI);
  const Point end = keyframe.sensor + static_cast<float>(length_m) * Point(std::cos(angle), std::sin(angle));
  keyframe.content = CodedContent({{end}, {}, {}, {}});
  return {keyframe, {x_m, 4.8, 0.5 * M_PI}};
}

TEST(BeamFan, ContradictsWhatItLookedThrough) {
  EXPECT_TRUE(fan(7.0, 3.3).contradicts(kSurface, kTolerance_m));
  EXPECT_TRUE(fan(7.0, 9.0).contradicts(kSurface, kTolerance_m));
}

TEST(BeamFan, ContradictsAWallThatItSawNearer) {
  EXPECT_TRUE(fan(7.0, 2.7).contradicts(kSurface, kTolerance_m));
}

TEST(BeamFan, AgreesWithinTheTolerance) {
  EXPECT_FALSE(fan(7.0, 2.95).contradicts(kSurface, kTolerance_m));
  EXPECT_FALSE(fan(7.0, 3.05).contradicts(kSurface, kTolerance_m));
}

TEST(BeamFan, IsSilentOnWhatStandsBehindSomething) {
  EXPECT_FALSE(fan(7.0, 2.0).contradicts(kSurface, kTolerance_m));
}

TEST(BeamFan, IsSilentOnTheOtherFaceOfAWall) {
  SurfacePoint other = kSurface;
  other.normal = -other.normal;
  EXPECT_FALSE(fan(7.0, 2.7).contradicts(other, kTolerance_m));
  EXPECT_FALSE(fan(7.0, 3.3).contradicts(other, kTolerance_m));
}

TEST(BeamFan, IsSilentOnWhatItsBeamsPassedBeside) {
  EXPECT_FALSE(fan(7.0, 3.3, 0.03).contradicts(kSurface, kTolerance_m));
  EXPECT_TRUE(fan(7.0, 3.3, 0.01).contradicts(kSurface, kTolerance_m));
}

TEST(BeamFan, IsSilentOnAWallThatItLookedAlong) {
  const SurfacePoint along{{10.0, 5.0}, {-0.02, 0.9998}};
  EXPECT_FALSE(fan(7.0, 4.5).contradicts(along, kTolerance_m)) << "ends 0.03 m behind the surface";
  EXPECT_TRUE(fan(7.0, 12.0).contradicts({{10.0, 5.0}, {-0.2, 0.98}}, kTolerance_m));
}

TEST(SurfaceAt, FacesTheLaserWhereTheKeyframeKnowsNoSurface) {
  const Point sensor(1.0F, 0.0F), hit(1.0F, 2.0F);
  EXPECT_NEAR((surface_at({}, sensor, hit).normal - types::Vector2(0.0, -1.0)).norm(), 0.0, 1e-6);
  const std::vector<Surfel> surfels{{{1.05F, 2.0F}, {0.6F, -0.8F}, true}, {{1.3F, 2.0F}, {1.0F, 0.0F}, true}};
  EXPECT_NEAR((surface_at(surfels, sensor, hit).normal - types::Vector2(0.6, -0.8)).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace topo::slam

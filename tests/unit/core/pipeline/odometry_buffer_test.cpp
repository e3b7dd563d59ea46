// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/odometry_buffer.hpp"

#include <gtest/gtest.h>

namespace topo::pipeline {
namespace {

using std::chrono::milliseconds;
using types::Stamp;

types::Odometry sample(int ms, double x_m, double v_mps = 0.0) {
  return {Stamp{milliseconds(ms)}, types::Transform2<types::Odom, types::Base>(x_m, 0.0, 0.0), {v_mps, 0.0}};
}

TEST(OdometryBuffer, InterpolatesBetweenSamples) {
  OdometryBuffer buffer;
  EXPECT_FALSE(buffer.at(Stamp{milliseconds(5)}).has_value());
  buffer.add(sample(100, 1.0));
  buffer.add(sample(200, 2.0));
  EXPECT_NEAR(buffer.at(Stamp{milliseconds(150)})->x_m, 1.5, 1e-12);
  EXPECT_NEAR(buffer.at(Stamp{milliseconds(200)})->x_m, 2.0, 1e-12);
  EXPECT_NEAR(buffer.at(Stamp{milliseconds(50)})->x_m, 1.0, 1e-12);
  EXPECT_TRUE(buffer.covers(Stamp{milliseconds(200)}));
  EXPECT_FALSE(buffer.covers(Stamp{milliseconds(201)}));
}

TEST(OdometryBuffer, CarriesOnForALittleWhile) {
  OdometryBuffer buffer;
  buffer.add(sample(100, 1.0, 0.5));
  EXPECT_NEAR(buffer.at(Stamp{milliseconds(300)})->x_m, 1.1, 1e-9);
  EXPECT_NEAR(buffer.at(Stamp{milliseconds(9000)})->x_m, 1.15, 1e-9) << "not for ever";
}

TEST(OdometryBuffer, CarriesOnAsLongAsItsParametersSay) {
  OdometryBufferParams params;
  params.extrapolated_max = milliseconds(100);
  OdometryBuffer usual, brief(params);
  usual.add(sample(1000, 0.0, 1.0));
  brief.add(sample(1000, 0.0, 1.0));
  const Stamp later{milliseconds(1200)};
  ASSERT_TRUE(usual.at(later).has_value());
  ASSERT_TRUE(brief.at(later).has_value());
  EXPECT_NEAR(usual.at(later)->x_m, 0.2, 1e-9);
  EXPECT_NEAR(brief.at(later)->x_m, 0.1, 1e-9);
}

TEST(OdometryBuffer, RefusesWhatIsNotNewer) {
  OdometryBuffer buffer;
  buffer.add(sample(200, 2.0));
  buffer.add(sample(100, 7.0));
  buffer.add(sample(200, 9.0));
  EXPECT_NEAR(buffer.at(Stamp{milliseconds(150)})->x_m, 2.0, 1e-12);
}

TEST(OdometryBuffer, ForgetsWhatIsOld) {
  OdometryBuffer buffer;
  for (int i = 0; i < 1000; ++i) buffer.add(sample(i * 100, i));
  EXPECT_NEAR(buffer.at(Stamp{milliseconds(0)})->x_m, 969.0, 1.0) << "three seconds are kept";
}

}  // namespace
}  // namespace topo::pipeline

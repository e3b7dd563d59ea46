// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/line_age.hpp"

#include <gtest/gtest.h>

#include <random>

namespace topo::io {
namespace {

using std::chrono::milliseconds;

constexpr double kRise = 200e-6;

/// Waits of data that come 40 times a second, with a delay as a function of the time since the beginning.
template <class Delay>
types::Duration longest_wait(double duration_s, double drift, Delay delay) {
  LineAge age(kRise);
  types::Duration longest{};
  for (double t = 0.0; t < duration_s; t += 0.025) {
    const types::Duration wait = types::from_seconds(delay(t));
    const types::Duration difference = types::from_seconds(drift * t) + wait;
    longest = std::max(longest, age.update(difference, types::stamp_from_seconds(100.0 + t)));
  }
  return longest;
}

TEST(LineAge, clocksThatDriftAreNoDelay) {
  for (const double drift : {-100e-6, 0.0, 100e-6, 190e-6})
    EXPECT_LT(longest_wait(7200.0, drift, [](double) { return 0.01; }), milliseconds(1)) << drift;
}

TEST(LineAge, aDelayThatGrowsIsNotTakenForDrift) {
  for (const double growth : {0.03, 0.05, 0.08}) {
    LineAge age(kRise);
    double t = 0.0;
    while (age.update(types::from_seconds(growth * t), types::stamp_from_seconds(t + 1.0)) <=
           milliseconds(300))
      t += 0.025;
    EXPECT_NEAR(t, 0.3 / growth, 0.3) << growth;
  }
}

TEST(LineAge, measuresEachWaitAgainstTheShortest) {
  LineAge age(kRise);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> wait(0.0, 0.2);
  double shortest = 1.0;
  for (int i = 0; i < 400; ++i) {
    const double now = wait(random);
    shortest = std::min(shortest, now);
    const double found =
        types::to_seconds(age.update(types::from_seconds(now), types::stamp_from_seconds(0.025 * i)));
    EXPECT_NEAR(found, now - shortest, 0.01 * 0.2 + kRise * 10.0);
    EXPECT_GE(found, 0.0);
  }
}

TEST(LineAge, aKnownBeginningShowsADelayFromTheFirst) {
  LineAge age(kRise);
  age.begin(milliseconds(20), types::stamp_from_seconds(1.0));
  EXPECT_EQ(age.update(milliseconds(520), types::stamp_from_seconds(1.0)), milliseconds(500));
  age.reset();
  EXPECT_EQ(age.update(milliseconds(520), types::stamp_from_seconds(2.0)), types::Duration{});
}

}  // namespace
}  // namespace topo::io

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/pioneer/sip_delay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace topo::pioneer {
namespace {

using std::chrono::milliseconds;
using types::Duration;
using types::Stamp;

constexpr Duration kWire = milliseconds(5);

struct Errors {
  double mean_ms = 0.0, worst_ms = 0.0;
};

/// Packets with a true cycle of `cycle_ms`, delayed by 20 to 60 ms; errors against the delay beyond 20 ms.
Errors run(double cycle_ms, int packets, double loss = 0.0) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> extra_ms(0.0, 40.0), chance(0.0, 1.0);
  SipDelay delay;
  Errors errors;
  int judged = 0;
  for (int k = 0; k < packets; ++k) {
    const double late_ms = extra_ms(random);
    if (chance(random) < loss) continue;
    const double sent_ms = 5000.0 + k * cycle_ms + 20.0 + late_ms;
    const Duration age = delay.update(types::stamp_from_seconds(sent_ms * 1e-3) + kWire, kWire);
    if (k < packets / 2) continue;
    const double error_ms = std::abs(types::to_seconds(age - kWire) * 1e3 - late_ms);
    errors.mean_ms += error_ms;
    errors.worst_ms = std::max(errors.worst_ms, error_ms);
    ++judged;
  }
  errors.mean_ms /= judged;
  return errors;
}

TEST(SipDelay, SteadyArrivalIsAsOldAsItsTimeOnTheWire) {
  SipDelay delay;
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(delay.update(Stamp{milliseconds(1000 + 100 * k)}, kWire), kWire);
    EXPECT_EQ(delay.last_step(), 1);
  }
}

TEST(SipDelay, FindsTheJitterOfEachPacket) {
  const Errors errors = run(100.0, 600);
  EXPECT_LT(errors.mean_ms, 2.0);
  EXPECT_LT(errors.worst_ms, 6.0);
}

TEST(SipDelay, FollowsARobotWhoseClockIsOff) {
  for (const double cycle_ms : {99.5, 100.05, 100.5}) {
    const Errors errors = run(cycle_ms, 1200);
    EXPECT_LT(errors.mean_ms, 4.0) << cycle_ms;
    EXPECT_LT(errors.worst_ms, 12.0) << cycle_ms;
  }
}

TEST(SipDelay, SurvivesLostPackets) {
  const Errors errors = run(100.0, 600, 0.2);
  EXPECT_LT(errors.mean_ms, 2.5);
}

TEST(SipDelay, CountsLostCycles) {
  SipDelay delay;
  delay.update(Stamp{milliseconds(1000)}, {});
  delay.update(Stamp{milliseconds(1100)}, {});
  delay.update(Stamp{milliseconds(1400)}, {});
  EXPECT_EQ(delay.last_step(), 3);
}

TEST(SipDelay, RecoversAfterABurst) {
  SipDelay delay;
  int ms = 1000;
  for (int k = 0; k < 50; ++k, ms += 100) delay.update(Stamp{milliseconds(ms)}, {});
  ms += 900;  // the host slept: ten packets at once
  for (int k = 0; k < 10; ++k) delay.update(Stamp{milliseconds(ms)}, {});
  for (int k = 0; k < 100; ++k) {
    ms += 100;
    const Duration age = delay.update(Stamp{milliseconds(ms)}, {});
    EXPECT_LE(age, milliseconds(1)) << k;
  }
}

TEST(SipDelay, AgeStaysWithinOneCycleWhateverArrives) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> gap_ms(0, 700);
  SipDelay delay;
  Stamp arrival{milliseconds(1)};
  for (int k = 0; k < 3000; ++k) {
    arrival += milliseconds(gap_ms(random));
    const Duration age = delay.update(arrival, kWire);
    ASSERT_GE(age, kWire);
    ASSERT_LE(age, kWire + milliseconds(100));
  }
}

}  // namespace
}  // namespace topo::pioneer

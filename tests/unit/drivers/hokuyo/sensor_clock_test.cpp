// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/hokuyo/sensor_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using types::Duration;
using types::Stamp;

/// A sensor whose counter runs at its own rate, read through a link with delays.
class Rig {
 public:
  double drift_ppm = 0.0;  ///< host seconds gained a device second
  double counter_at_start_ms = 0.0;
  Duration out = 200us, back = 200us;  ///< of a TM1
  Duration latency = 19ms;             ///< from the scan's stamp to its fastest arrival
  Duration jitter = 0ms;               ///< added to it, evenly spread
  Stamp start{1000s};

  [[nodiscard]] double device_ms(Stamp t) const {
    return counter_at_start_ms + types::to_seconds(t - start) * 1e3 / (1.0 + drift_ppm * 1e-6);
  }
  [[nodiscard]] std::uint32_t counter(Stamp t) const {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(device_ms(t))) & 0xFFFFFF);
  }
  void round_trip(SensorClock& clock, Stamp t) const {
    clock.add_round_trip(counter(t + out), t, t + out + back);
  }
  /// Error of the stamp that the clock gives to a scan measured at `t`.
  double scan_error_ms(SensorClock& clock, Stamp t) {
    const Duration late =
        jitter.count() == 0
            ? 0ns
            : Duration(std::uniform_int_distribution<std::int64_t>(0, jitter.count())(random_));
    last = clock.on_scan(counter(t), t + latency + late);
    return types::to_seconds(last.host - t) * 1e3;
  }
  SensorClock::Result last;

 private:
  std::mt19937 random_{42};
};

TEST(SensorClock, TheSmallestRoundTripCounts) {
  SensorClock clock;
  clock.reset(50ms);  // far from the truth: TM1 must win
  Rig rig;
  rig.out = 9ms;  // asymmetric and slow
  rig.back = 1ms;
  rig.round_trip(clock, rig.start);
  rig.out = 100us;
  rig.back = 150us;
  rig.round_trip(clock, rig.start + 20ms);
  rig.out = 1ms;
  rig.back = 9ms;
  rig.round_trip(clock, rig.start + 40ms);
  EXPECT_EQ(clock.best_round_trip(), 250us);
  EXPECT_LT(std::abs(rig.scan_error_ms(clock, rig.start + 100ms)), 1.1);
}

TEST(SensorClock, WithoutTm1TheNominalLatencyServes) {
  SensorClock clock;
  clock.reset(18750us);
  Rig rig;
  double worst = 0.0;
  for (int i = 0; i < 400; ++i)
    worst = std::max(worst, std::abs(rig.scan_error_ms(clock, rig.start + i * 25ms)));
  EXPECT_LT(worst, 1.5);
}

TEST(SensorClock, FollowsDriftUnderJitterForTenMinutes) {
  for (const double ppm : {-100.0, -30.0, 0.0, 30.0, 100.0}) {
    SensorClock clock;
    clock.reset(18750us);
    Rig rig;
    rig.drift_ppm = ppm;
    rig.jitter = 8ms;
    for (int i = 0; i < 10; ++i) rig.round_trip(clock, rig.start + i * 1ms);
    double worst = 0.0;
    // 25.013 ms: the millisecond counter is hit at every phase, as by a motor that is not tied to it.
    for (int i = 0; i < 24000; ++i)
      worst = std::max(worst, std::abs(rig.scan_error_ms(clock, rig.start + 100ms + i * 25013us)));
    EXPECT_LT(worst, 2.5) << ppm << " ppm";
    EXPECT_NEAR(clock.drift() * 1e6, ppm, 20.0);
    EXPECT_NEAR(types::to_seconds(clock.latency()) * 1e3, 19.0, 1.2);
  }
}

TEST(SensorClock, TheCounterWrapsWithoutAJump) {
  SensorClock clock;
  clock.reset(18750us);
  Rig rig;
  rig.counter_at_start_ms = 16777216.0 - 5000.0;
  rig.round_trip(clock, rig.start);
  for (int i = 0; i < 800; ++i) {
    EXPECT_LT(std::abs(rig.scan_error_ms(clock, rig.start + 50ms + i * 25ms)), 1.1) << i;
    EXPECT_FALSE(rig.last.jumped) << i;
  }
  EXPECT_GT(rig.last.device_ms, 16777216);
}

TEST(SensorClock, TheWrapMayFallBetweenTm1AndTheFirstScan) {
  SensorClock clock;
  clock.reset(18750us);
  Rig rig;
  rig.counter_at_start_ms = 16777216.0 - 20.0;
  for (int i = 0; i < 10; ++i) rig.round_trip(clock, rig.start + i * 4ms);
  EXPECT_LT(std::abs(rig.scan_error_ms(clock, rig.start + 100ms)), 1.1);
  EXPECT_TRUE(clock.synchronised());
}

TEST(SensorClock, ARestartOfTheDeviceIsAJumpAndTheLatencyStays) {
  SensorClock clock;
  clock.reset(10ms);
  Rig rig;
  rig.counter_at_start_ms = 500000.0;
  rig.round_trip(clock, rig.start);
  for (int i = 0; i < 200; ++i) (void)rig.scan_error_ms(clock, rig.start + 50ms + i * 25ms);
  rig.counter_at_start_ms = 0.0;  // back
  EXPECT_LT(std::abs(rig.scan_error_ms(clock, rig.start + 6s)), 1.6);
  EXPECT_TRUE(rig.last.jumped);
  EXPECT_LT(std::abs(rig.scan_error_ms(clock, rig.start + 6025ms)), 1.6);
  EXPECT_FALSE(rig.last.jumped);
  rig.counter_at_start_ms = 100000.0;  // forward
  EXPECT_LT(std::abs(rig.scan_error_ms(clock, rig.start + 7s)), 1.6);
  EXPECT_TRUE(rig.last.jumped);
}

TEST(SensorClock, ALateBurstDoesNotMoveTheClock) {
  SensorClock clock;
  clock.reset(18750us);
  Rig rig;
  rig.round_trip(clock, rig.start);
  for (int i = 0; i < 200; ++i) {
    rig.latency =
        i >= 100 && i < 140 ? 19ms + (140 - i) * 25ms : 19ms;  // a second of silence, then all at once
    EXPECT_LT(std::abs(rig.scan_error_ms(clock, rig.start + 50ms + i * 25ms)), 1.1) << i;
    EXPECT_FALSE(rig.last.jumped);
  }
}

TEST(SensorClock, ALineThatIsLateFromTheBeginningIsKnown) {
  SensorClock clock;
  clock.reset(18750us);
  Rig rig;
  rig.back = 400ms;  // both the answers to TM1 and the scans
  rig.latency = 419ms;
  for (int i = 0; i < 10; ++i) rig.round_trip(clock, rig.start + i * 401ms);
  for (int i = 0; i < 4000; ++i) {
    (void)rig.scan_error_ms(clock, rig.start + 5s + i * 25ms);
    ASSERT_NEAR(types::to_seconds(rig.last.late), 0.4, 0.025) << i;  // 200 ppm of 100 s, and the counter
  }
}

TEST(SensorClock, AGoodLineIsNotLateFromTheBeginning) {
  SensorClock clock;
  clock.reset(18750us);
  Rig rig;
  rig.out = rig.back = 8ms;  // USB 1.1 at its worst
  for (int i = 0; i < 10; ++i) rig.round_trip(clock, rig.start + i * 20ms);
  for (int i = 0; i < 400; ++i) {
    (void)rig.scan_error_ms(clock, rig.start + 500ms + i * 25ms);
    ASSERT_LT(types::to_seconds(rig.last.late), 0.012) << i;
  }
}

TEST(SensorClock, AFrozenCounterIsToldAtTheThirdSameValue) {
  SensorClock clock;
  clock.reset(18750us);
  EXPECT_FALSE(clock.on_scan(1000, Stamp{10s}).repeated);
  const auto second = clock.on_scan(1000, Stamp{10025ms});
  EXPECT_TRUE(second.repeated);
  EXPECT_FALSE(second.frozen);
  EXPECT_TRUE(clock.on_scan(1000, Stamp{10050ms}).frozen);
  EXPECT_FALSE(clock.on_scan(1075, Stamp{10075ms}).repeated);
}

TEST(SensorClock, AnAbsurdTm1IsNotBelieved) {
  SensorClock clock;
  clock.reset(18750us);
  clock.add_round_trip(777777, Stamp{1000s}, Stamp{1000s + 1ms});
  Rig rig;
  EXPECT_LT(std::abs(rig.scan_error_ms(clock, rig.start + 100ms)), 1.5);
  EXPECT_FALSE(clock.synchronised());
}

}  // namespace
}  // namespace topo::hokuyo

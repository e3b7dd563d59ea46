// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// From an opened port to the first scan.
#include <cmath>
#include <numbers>

#include "core/types/se2.hpp"
#include "tests/unit/drivers/hokuyo/connection_fixture.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using namespace testing_scip;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class SessionConnect : public SessionTest {};

TEST_F(SessionConnect, EveryModelStreams) {
  for (const Sample& sample : kSamples) {
    line = {};
    scans = 0;
    line.has_baud = sample.family == Family::kUtm || sample.family == Family::kUrg;
    start(sample);
    ASSERT_TRUE(run_scans(20, 5s)) << connection->message();
    EXPECT_EQ(connection->health(), Health::kStreaming);
    EXPECT_EQ(connection->info()->serial_number, sample.serial);
    EXPECT_EQ(scan.beams, sample.amax - sample.amin + 1);
    EXPECT_NEAR(scan.geometry.period_s, 60.0 / sample.rpm, 1e-6);
    EXPECT_NEAR(scan.geometry.angle_increment_rad, 2 * std::numbers::pi / sample.ares, 1e-7);
    EXPECT_NEAR(scan.geometry.time_increment_s, 60.0 / sample.rpm / sample.ares, 1e-9);
    EXPECT_NEAR(scan.geometry.range_max_m, sample.dmax * 1e-3, 1e-6);
    for (std::size_t i = 0; i < scan.beams; ++i) {
      ASSERT_NEAR(scan.range_m[i], FakeSensor::range_mm(i + static_cast<std::size_t>(sample.amin)) * 1e-3,
                  1e-6);
    }
    // Stamp of the first beam: within the counter's millisecond of the truth.
    const types::Duration first = types::from_seconds(sample.amin * 60.0 / sample.rpm / sample.ares);
    EXPECT_LT(std::abs(types::to_seconds(scan.first_beam - sensor->measured.back() - first)), 1.3e-3);
    EXPECT_EQ(connection->counters().scans, 20U);
    EXPECT_EQ(connection->counters().lost_scans, 0U);
    EXPECT_EQ(scan.sequence, 20U);
    EXPECT_EQ(connection->counters().checksum_errors, 0U);
  }
}

TEST_F(SessionConnect, AnglesAreThoseOfTheSteps) {
  start(urg());
  ASSERT_TRUE(run_scans(1, 5s));
  EXPECT_NEAR(static_cast<double>(scan.angle_rad(0)) / types::kDegree_rad, -119.53, 0.01);
  EXPECT_NEAR(static_cast<double>(scan.angle_rad(681)) / types::kDegree_rad, 119.88, 0.01);
  EXPECT_NEAR(scan.angle_rad(340), 0.0, 1e-5);
}

TEST_F(SessionConnect, SwitchesAUrgFromScip1) {
  line.has_baud = true;
  start(urg());
  sensor->scip1 = true;
  ASSERT_TRUE(run_scans(3, 5s)) << connection->message();
  EXPECT_EQ(sensor->count("SCIP2.0"), 1);
}

TEST_F(SessionConnect, NeverTriesIntensityOnAUrg) {
  start(urg(), {.intensity = true});
  ASSERT_TRUE(run_scans(3, 5s));
  EXPECT_EQ(sensor->count("ME"), 0);
  EXPECT_FALSE(scan.has_intensity);
  EXPECT_THAT(connection->message(), HasSubstr("no intensities"));
}

/// "KEY:value;c" with its check character.
std::string summed(const std::string& text) { return text + ";" + std::string(1, checksum(text)) + "\n"; }

TEST_F(SessionConnect, AModelThatIsNotKnownStreamsAndIsNamed) {
  start(ust());
  sensor->vv = summed("VEND:Hokuyo Automatic Co., Ltd.") + summed("PROD:UST-30LX") + summed("FIRM:1.0.0") +
               summed("PROT:SCIP 2.2") + summed("SERI:17");
  sensor->pp = summed("MODL:UST-30LX") + summed("DMIN:0") + summed("DMAX:30000") + summed("ARES:2880") +
               summed("AMIN:0") + summed("AMAX:2160") + summed("AFRT:1080") + summed("SCAN:2400");
  ASSERT_TRUE(run_scans(5, 5s)) << connection->message();
  EXPECT_THAT(sensor->heard, Contains("MD0000216002000")) << "2 by 2";
  EXPECT_EQ(scan.beams, 1081);
  EXPECT_NEAR(scan.geometry.angle_increment_rad, 4.0 * std::numbers::pi / 2880.0, 1e-7);
  EXPECT_NEAR(scan.geometry.range_min_m, 0.02, 1e-6) << "DMIN 0 is no distance";
  EXPECT_EQ(connection->info()->serial_number, "17");
  EXPECT_THAT(connection->info()->assumed, HasSubstr("\"UST-30LX\" is not known"));
  EXPECT_EQ(connection->health(), Health::kStreaming);
}

TEST_F(SessionConnect, AScannerUpsideDownGivesClockwiseBeams) {
  start(utm_ew());
  ASSERT_TRUE(run_scans(1, 5s));
  const types::ScanGeometry upright = scan.geometry;
  const types::Duration first = scan.first_beam - sensor->measured.back();
  line = {};
  scans = 0;
  ConnectionConfig config;
  config.mirrored = true;
  start(utm_ew(), config);
  ASSERT_TRUE(run_scans(1, 5s));
  EXPECT_FLOAT_EQ(scan.geometry.angle_min_rad, -upright.angle_min_rad);
  EXPECT_FLOAT_EQ(scan.geometry.angle_increment_rad, -upright.angle_increment_rad);
  EXPECT_FLOAT_EQ(scan.geometry.time_increment_s, upright.time_increment_s) << "in the order of their times";
  EXPECT_LT(std::abs(types::to_seconds(scan.first_beam - sensor->measured.back() - first)), 2e-3);
}

TEST_F(SessionConnect, MaskedBeamsMeasureNothing) {
  for (const bool mirrored : {false, true}) {
    line = {};
    scans = 0;
    ConnectionConfig config;
    config.mirrored = mirrored;
    config.masks.all = {types::Sector{40.0 * types::kDegree_rad, 45.0 * types::kDegree_rad},
                        types::Sector{170.0 * types::kDegree_rad, 190.0 * types::kDegree_rad}};
    config.masks.count = 2;
    start(utm_ew(), config);
    ASSERT_TRUE(run_scans(1, 5s));
    int masked = 0;
    for (std::size_t i = 0; i < scan.beams; ++i) {
      const double angle_deg = static_cast<double>(scan.angle_rad(i)) / types::kDegree_rad;
      const bool inside = angle_deg > 39.99 && angle_deg < 45.01;
      EXPECT_EQ(std::isnan(scan.range_m[i]), inside) << angle_deg;
      masked += inside ? 1 : 0;
    }
    EXPECT_EQ(masked, 21);
  }
}

TEST_F(SessionConnect, StreamsIntensity) {
  start(utm_ew(), {.intensity = true});
  ASSERT_TRUE(run_scans(3, 5s));
  EXPECT_THAT(sensor->heard, Contains("ME0000108001000"));
  EXPECT_TRUE(scan.has_intensity);
  EXPECT_EQ(scan.intensity[1080], 1080);
}

TEST_F(SessionConnect, UsbUtmGetsIntensityOnlyInClusters) {
  start(utm_usb(), {.intensity = true});
  ASSERT_TRUE(run_scans(3, 5s));
  EXPECT_THAT(sensor->heard, Contains("ME0000108002000"));  // firmware 1.16.01
  EXPECT_EQ(scan.beams, 541);
  EXPECT_NEAR(scan.geometry.angle_increment_rad, 2 * 2 * std::numbers::pi / 1440, 1e-6);
  EXPECT_NEAR(scan.angle_rad(0), (0.5 - 540) * 2 * std::numbers::pi / 1440, 1e-5);
}

TEST_F(SessionConnect, SkipsScansAsConfigured) {
  start(utm_ew(), {.skip_scans = 1});
  ASSERT_TRUE(run_scans(10, 5s));
  EXPECT_THAT(sensor->heard, Contains("MD0000108001100"));
  EXPECT_NEAR(scan.geometry.period_s, 0.05, 1e-6);
  EXPECT_EQ(connection->counters().lost_scans, 0U);
}

TEST_F(SessionConnect, FindsTheLineSpeed) {
  line.has_baud = true;
  start(urg());
  sensor->baud = 115200;
  ASSERT_TRUE(run_scans(1, 20s)) << connection->message();
  EXPECT_EQ(line.baud, 115200);
}

TEST_F(SessionConnect, WrongSerialNumberIsTold) {
  start(utm_ew(), {.serial_number = "H0902680"});
  ASSERT_TRUE(run_health(Health::kWrongDevice, 5s));
  EXPECT_THAT(connection->message(), HasSubstr("H0123456"));
  EXPECT_THAT(connection->message(), HasSubstr("H0902680"));
  EXPECT_THAT(connection->message(), HasSubstr("/dev/scripted"));
  run_for(60s);
  EXPECT_EQ(scans, 0);
  // Told once, however often it is tried again.
  EXPECT_EQ(changes.size(), 2U);
}

TEST_F(SessionConnect, RightSerialNumberPasses) {
  start(utm_ew(), {.serial_number = "00123456"});
  EXPECT_TRUE(run_scans(1, 5s));
}

/// On TCP (no line speed) as on USB; a sensor that was exchanged while the line was cut.
TEST_F(SessionConnect, EveryConnectionChecksTheSerialNumber) {
  for (const bool usb : {false, true}) {
    line.has_baud = usb;
    start(utm_ew(), {.serial_number = "H0123456"});
    ASSERT_TRUE(run_scans(3, 10s)) << usb;
    sensor->vv = utm_usb().vv;
    sensor->power_cycle();
    line.unplug();
    ASSERT_TRUE(run_health(Health::kWrongDevice, 20s)) << usb << connection->message();
    EXPECT_THAT(connection->message(), HasSubstr("H0902680"));
    EXPECT_THAT(connection->message(), HasSubstr("expected H0123456"));
    scans = 0;
    run_for(30s);
    EXPECT_EQ(scans, 0) << usb;
    sensor->vv = utm_ew().vv;
    EXPECT_TRUE(run_scans(3, 20s)) << usb;
    connection.reset();
  }
}

/// Behind a bridge on TCP, which goes on while the sensor is exchanged.
TEST_F(SessionConnect, ASensorThatIsExchangedWithoutALossOfTheLineIsNoticed) {
  for (const bool deaf_to_quit : {false, true}) {  // found by the probe, or after the reset
    start(utm_ew(), {.serial_number = "H0123456"});
    ASSERT_TRUE(run_scans(3, 10s));
    sensor->mute_scans = true;
    if (deaf_to_quit) sensor->mute_commands = "QT";
    ASSERT_TRUE(run_health(Health::kSilent, 5s));
    sensor->vv = utm_usb().vv;
    sensor->mute_scans = false;
    ASSERT_TRUE(run_health(Health::kDisconnected, 5s)) << connection->message();
    EXPECT_THAT(connection->message(), HasSubstr("exchanged (serial number H0902680, before H0123456)"));
    sensor->mute_commands.clear();
    scans = 0;
    ASSERT_TRUE(run_health(Health::kWrongDevice, 10s));
    run_for(10s);
    EXPECT_EQ(scans, 0);
    connection.reset();
  }
}

TEST_F(SessionConnect, AnUnknownSensorThatIsExchangedIsReadAnew) {
  start(utm_ew());
  ASSERT_TRUE(run_scans(3, 10s));
  sensor->vv = ust().vv;
  sensor->pp = ust().pp;
  sensor->mute_scans = true;
  ASSERT_TRUE(run_health(Health::kDisconnected, 10s));
  sensor->mute_scans = false;
  ASSERT_TRUE(run_scans(3, 10s)) << connection->message();
  EXPECT_EQ(connection->info()->serial_number, ust().serial);
  EXPECT_FLOAT_EQ(scan.geometry.range_max_m, 30.0F);
}

TEST_F(SessionConnect, APioneerOnThePortIsNamed) {
  start(utm_ew());
  sensor->mute = true;
  line.on_write = [&](std::string_view) { line.send(std::string("\xfa\xfb\x03\x00\x00\x00", 6)); };
  ASSERT_TRUE(run_health(Health::kWrongDevice, 10s));
  EXPECT_THAT(connection->message(), HasSubstr("Pioneer"));
}

TEST_F(SessionConnect, GarbageOnThePortIsShown) {
  start(utm_ew());
  line.on_write = [&](std::string_view) { line.send("$GPGGA,123519,4807.038,N\r\n"); };
  ASSERT_TRUE(run_health(Health::kWrongDevice, 10s));
  EXPECT_THAT(connection->message(), HasSubstr("24 47 50 47"));
}

TEST_F(SessionConnect, SilenceOnThePortIsTold) {
  line.has_baud = true;
  start(utm_ew());
  sensor->mute = true;
  ASSERT_TRUE(run_health(Health::kSilent, 20s));
  EXPECT_THAT(connection->message(), HasSubstr("no answer"));
  EXPECT_THAT(connection->message(), HasSubstr("115200"));
}

TEST_F(SessionConnect, MissingDeviceBacksOffToFiveSeconds) {
  line.refuse = true;
  start(utm_ew());
  run_for(60s);
  EXPECT_EQ(connection->health(), Health::kDisconnected);
  EXPECT_THAT(connection->message(), HasSubstr("no such device"));
  EXPECT_EQ(changes.size(), 1U);
  ASSERT_GE(line.connect_stamps.size(), 6U);
  std::vector<double> waits;
  for (std::size_t i = 1; i < line.connect_stamps.size(); ++i) {
    waits.push_back(types::to_seconds(line.connect_stamps[i] - line.connect_stamps[i - 1]));
  }
  EXPECT_NEAR(waits[0], 0.5, 0.03);
  EXPECT_NEAR(waits[1], 1.0, 0.03);
  EXPECT_NEAR(waits[2], 2.0, 0.03);
  EXPECT_NEAR(waits[3], 4.0, 0.03);
  EXPECT_NEAR(waits.back(), 5.0, 0.03);
  line.refuse = false;
  EXPECT_TRUE(run_scans(1, 7s));
}

TEST_F(SessionConnect, LeavesAdjustModeFromBefore) {
  start(utm_ew());
  sensor->adjust = true;
  EXPECT_TRUE(run_scans(1, 5s)) << connection->message();
}

TEST_F(SessionConnect, ASensorThatStillStreamsIsQuietedFirst) {
  start(utm_ew());
  ASSERT_TRUE(run_scans(5, 5s));
  // The daemon dies without a word; the next one finds the stream running.
  connection = std::make_unique<Connection>(ConnectionConfig{.name = "front"},
                                            std::make_unique<mocks::ScriptedConnector>(line));
  ASSERT_TRUE(run_scans(5, 5s)) << connection->message();
}

TEST_F(SessionConnect, WaitsForTheLaserToSpinUp) {
  start(utm_ew());
  sensor->laser_failures = 5;
  EXPECT_TRUE(run_scans(1, 10s)) << connection->message();
}

TEST_F(SessionConnect, ALaserThatNeverStartsIsAFault) {
  start(utm_ew());
  sensor->laser_failures = -1;
  ASSERT_TRUE(run_health(Health::kFault, 20s));
  EXPECT_THAT(connection->message(), HasSubstr("status 01"));
  EXPECT_THAT(connection->message(), HasSubstr("Stable 000 no error."));
}

TEST_F(SessionConnect, StreamsWithoutClockAdjustment) {
  start(utm_ew());
  sensor->adjust_status = "0E";
  ASSERT_TRUE(run_scans(20, 5s)) << connection->message();
  EXPECT_LT(std::abs(types::to_seconds(scan.first_beam - sensor->measured.back())), 2e-3);
}

TEST_F(SessionConnect, HarmfulParametersAreRefused) {
  start(utm_ew());
  sensor->pp = "MODL:UTM-30LX-EW;I\n";
  ASSERT_TRUE(run_health(Health::kDamaged, 5s));
  EXPECT_THAT(connection->message(), HasSubstr("DMIN"));
}

TEST_F(SessionConnect, OneLostReplyIsAskedForAgain) {
  start(utm_ew());
  sensor->mute_commands = "PP";
  (void)run([&] { return sensor->count("PP") == 1; }, 5s);
  sensor->mute_commands.clear();
  EXPECT_TRUE(run_scans(1, 5s)) << connection->message();
  EXPECT_EQ(sensor->count("PP"), 2);
}

TEST_F(SessionConnect, AsymmetricDelaysAreHalvedByTheSmallestRoundTrip) {
  start(utm_ew());
  sensor->out = 3ms;
  sensor->back = 500us;
  sensor->counter_start_ms = 16777216.0 - 1000.0;  // and the counter wraps while streaming
  ASSERT_TRUE(run_scans(200, 10s));
  // (3 - 0.5) / 2 = 1.25 ms of asymmetry and one millisecond of the counter
  EXPECT_LT(std::abs(types::to_seconds(scan.first_beam - sensor->measured.back())), 2.3e-3);
  EXPECT_EQ(connection->counters().lost_scans, 0U);
}

TEST_F(SessionConnect, StampOffsetIsAdded) {
  start(utm_ew(), {.stamp_offset_s = 0.5});
  ASSERT_TRUE(run_scans(5, 5s));
  EXPECT_NEAR(types::to_seconds(scan.first_beam - sensor->measured.back()), 0.5, 1.3e-3);
}

}  // namespace
}  // namespace topo::hokuyo

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Scans, losses, silence, faults, unplugging.
#include <cmath>

#include "tests/unit/drivers/hokuyo/connection_fixture.hpp"

namespace topo::hokuyo {
namespace {

using namespace std::chrono_literals;
using namespace testing_scip;
using testing::HasSubstr;

class SessionStream : public SessionTest {
 protected:
  void SetUp() override {
    start(utm_ew());
    ASSERT_TRUE(run_scans(50, 5s)) << connection->message();
    sensor->heard.clear();
    changes.clear();
  }
};

TEST_F(SessionStream, ABadScanIsDroppedAndCounted) {
  sensor->corrupt_scans = 1;
  ASSERT_TRUE(run_scans(10, 5s));
  EXPECT_EQ(connection->counters().checksum_errors, 1U);
  EXPECT_EQ(connection->counters().lost_scans, 1U);
  EXPECT_EQ(connection->counters().resyncs, 0U);
  EXPECT_EQ(connection->counters().scans, 60U);
  EXPECT_EQ(scan.sequence, 61U);  // counts the lost one
  EXPECT_TRUE(sensor->heard.empty());
  EXPECT_TRUE(changes.empty());
}

TEST_F(SessionStream, ThreeBadScansInARowAreResynchronised) {
  sensor->corrupt_scans = 3;
  ASSERT_TRUE(run_scans(10, 5s)) << connection->message();
  EXPECT_EQ(connection->counters().resyncs, 1U);
  EXPECT_EQ(sensor->count("QT"), 1);
  EXPECT_EQ(sensor->resets, 0);
  EXPECT_EQ(line.connections, 1);
}

TEST_F(SessionStream, SwallowedScansAreFoundByTheStamps) {
  sensor->swallow_scans = 7;
  ASSERT_TRUE(run_scans(10, 5s));
  EXPECT_EQ(connection->counters().lost_scans, 7U);
  EXPECT_EQ(scan.sequence, 67U);
}

TEST_F(SessionStream, SilenceIsToldAndAPoliteRestartCures) {
  sensor->streaming = false;  // the stream just stops
  const types::Stamp before = line.now;
  ASSERT_TRUE(run_health(Health::kSilent, 2s));
  EXPECT_NEAR(types::to_seconds(line.now - before), 0.5, 0.05);
  EXPECT_THAT(connection->message(), HasSubstr("no scan"));
  ASSERT_TRUE(run_scans(1, 2s));
  EXPECT_EQ(connection->health(), Health::kStreaming);
  EXPECT_EQ(sensor->count("QT"), 1);
  EXPECT_EQ(sensor->count("II"), 1);
  EXPECT_EQ(sensor->resets, 0);
}

TEST_F(SessionStream, TheLadderGoesFromQtToRsToRbToANewConnection) {
  sensor->mute_scans = true;
  ASSERT_TRUE(run([&] { return line.connections == 2; }, 20s));
  EXPECT_EQ(sensor->resets, 1);
  EXPECT_EQ(sensor->reboots, 1);
  const auto first = [&](std::string_view command) {
    return std::find_if(sensor->heard.begin(), sensor->heard.end(),
                        [&](const auto& r) { return r == command; });
  };
  EXPECT_LT(first("QT"), first("RS"));
  EXPECT_LT(first("RS"), first("RB"));
  sensor->mute_scans = false;
  EXPECT_TRUE(run_scans(1, 10s)) << connection->message();
}

TEST_F(SessionStream, ADeadSensorIsTriedForEver) {
  sensor->mute = true;
  sensor->streaming = false;
  run_for(120s);
  EXPECT_EQ(connection->health(), Health::kSilent);
  EXPECT_LT(changes.size(), 6U);
  EXPECT_GE(line.connections, 10);
  sensor->mute = false;
  EXPECT_TRUE(run_scans(1, 10s)) << connection->message();
  EXPECT_GE(connection->counters().reconnects, 10U);
}

TEST_F(SessionStream, UnpluggingIsToldAndReconnected) {
  line.unplug();
  line.refuse = true;
  sensor->power_cycle();
  ASSERT_TRUE(run_health(Health::kDisconnected, 1s));
  EXPECT_THAT(connection->message(), HasSubstr("unplugged"));
  run_for(30s);
  line.refuse = false;
  ASSERT_TRUE(run_scans(50, 10s)) << connection->message();
  EXPECT_EQ(connection->counters().reconnects, 1U);
  EXPECT_EQ(connection->health(), Health::kStreaming);
  EXPECT_EQ(scan.sequence, 100U);
  // After good scans the back-off begins anew.
  line.connect_stamps.clear();
  line.unplug();
  const types::Stamp before = line.now;
  ASSERT_TRUE(run([&] { return !line.connect_stamps.empty(); }, 5s));
  EXPECT_NEAR(types::to_seconds(line.connect_stamps[0] - before), 0.5, 0.03);
}

TEST_F(SessionStream, HardwareTroubleIsToldWithTheSensorsWords) {
  sensor->ii = "STAT:Trouble!! Error No. =[00->33];" +
               std::string(1, checksum("STAT:Trouble!! Error No. =[00->33]")) + "\n";
  sensor->inject_status = "55";
  ASSERT_TRUE(run_health(Health::kFault, 1s));
  EXPECT_THAT(connection->message(), HasSubstr("status 55"));
  EXPECT_THAT(connection->message(), HasSubstr("hardware"));
  ASSERT_TRUE(run([&] { return connection->message().find("Trouble!!") != std::string::npos; }, 1s));
  ASSERT_TRUE(run_scans(1, 5s));
  EXPECT_EQ(sensor->resets, 1);
  EXPECT_EQ(connection->health(), Health::kStreaming);
}

TEST_F(SessionStream, AShortErrorCheckIsToldAndPasses) {
  sensor->inject_status = "21";
  ASSERT_TRUE(run_health(Health::kFault, 1s));
  sensor->inject_status = "98";
  ASSERT_TRUE(run_scans(1, 1s));
  EXPECT_EQ(connection->health(), Health::kStreaming);
  EXPECT_TRUE(sensor->heard.empty());
}

TEST_F(SessionStream, AFrozenClockIsAFaultAndCuredByAReset) {
  sensor->counter_start_ms = 60000.0;
  sensor->frozen = true;
  ASSERT_TRUE(run_health(Health::kFault, 1s));
  EXPECT_THAT(connection->message(), HasSubstr("stands still"));
  sensor->frozen = false;
  ASSERT_TRUE(run_scans(5, 5s));
  EXPECT_EQ(sensor->resets, 1);
}

TEST_F(SessionStream, ScansThatComeTooLateAreNotHandedOut) {
  types::Duration oldest{}, latest{};
  for (int i = 0; i < 40 && connection->health() == Health::kStreaming; ++i) {
    sensor->latency += 50ms;  // a queue on the line grows
    if (!run_scans(1, 300ms)) continue;
    oldest = std::max(oldest, scan.arrival - scan.first_beam);
    EXPECT_GE(scan.late, latest) << "the wait grows";
    latest = scan.late;
  }
  EXPECT_EQ(connection->health(), Health::kLate);
  EXPECT_THAT(connection->message(), HasSubstr("late"));
  EXPECT_GT(oldest, 800ms);  // late scans are better than none
  EXPECT_LE(latest, 1s);
  EXPECT_GE(sensor->count("QT"), 1);
  sensor->latency = 500us;
  ASSERT_TRUE(run_scans(50, 20s)) << connection->message();
  EXPECT_LT(scan.arrival - scan.first_beam, 50ms);
  EXPECT_LT(scan.late, 50ms);
}

TEST_F(SessionStream, ALineThatIsSlowForHalfASecondBeginsANewStream) {
  ASSERT_TRUE(run_scans(20, 2s));
  sensor->latency += 400ms;
  int late = 0;
  for (int i = 0; i < 60 && connection->health() == Health::kStreaming; ++i)
    if (run_scans(1, 600ms)) late += scan.late > 300ms ? 1 : 0;
  EXPECT_EQ(connection->health(), Health::kLate);
  EXPECT_GE(late, 15);
  EXPECT_LE(late, 20);
}

TEST_F(SessionStream, AShortHoldUpIsToldWithTheScan) {
  ASSERT_TRUE(run_scans(20, 2s));
  EXPECT_LT(scan.late, 20ms);
  sensor->latency += 350ms;
  ASSERT_TRUE(run_scans(1, 600ms));
  EXPECT_GT(scan.late, 300ms);
  sensor->latency -= 350ms;
  ASSERT_TRUE(run_scans(15, 2s));
  EXPECT_LT(scan.late, 20ms);
  EXPECT_EQ(connection->health(), Health::kStreaming);
}

TEST_F(SessionStream, StampsFollowADriftingSensor) {
  sensor->drift_ppm = 80.0;
  double worst_s = 0.0;
  for (int i = 0; i < 300; ++i) {
    ASSERT_TRUE(run_scans(20, 5s));
    worst_s = std::max(worst_s, std::abs(types::to_seconds(scan.first_beam - sensor->measured.back())));
  }
  EXPECT_LT(worst_s, 2.5e-3);
  EXPECT_EQ(connection->counters().lost_scans, 0U);
}

TEST_F(SessionStream, CloseSendsQtAndLeavesTheLaserOff) {
  connection->close(1s);
  EXPECT_EQ(sensor->count("QT"), 1);
  EXPECT_FALSE(sensor->laser);
  EXPECT_FALSE(line.connected());
  EXPECT_EQ(connection->health(), Health::kDisconnected);
}

TEST_F(SessionStream, CloseIsBoundedWhenTheSensorIsDead) {
  sensor->mute = true;
  const types::Stamp before = line.now;
  connection->close(200ms);
  EXPECT_LE(line.now - before, 210ms);
}

TEST_F(SessionStream, BytesInSmallPiecesGiveTheSameScans) {
  line.max_read = 7;
  ASSERT_TRUE(run_scans(20, 5s));
  EXPECT_EQ(connection->counters().lost_scans, 0U);
  EXPECT_FLOAT_EQ(scan.range_m[17], 1.017F);
}

TEST_F(SessionStream, AStreamThatBeginsOnALateLineIsLate) {
  start(utm_ew());
  sensor->back = sensor->latency = 400ms;
  ASSERT_TRUE(run_scans(1, 30s)) << connection->message();
  EXPECT_GT(scan.late, 370ms) << "not even the first scan is taken for a fresh one";
  EXPECT_EQ(sensor->count("TM1"), 10) << "each was waited for";
}

}  // namespace
}  // namespace topo::hokuyo

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/scan_worker.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/unit/drivers/hokuyo/fake_sensor.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

TEST(ScanWorker, CountsTheScansThatAFullRingRefusedAndNothingElse) {
  mocks::ScriptedLine line;
  hokuyo::testing_scip::FakeSensor sensor(line, hokuyo::testing_scip::kSamples[0]);
  const auto hand_overs = std::make_unique<HandOvers>();
  Vitals vitals("front");
  // More scans than the ring takes, and then some steps, on the line's clock, in which none comes.
  constexpr std::size_t kScans = kScanRing + 20;
  types::Stamp silent_since{};
  line.on_wait = [&, wait = line.on_wait](types::Stamp until) {
    wait(until);
    if (sensor.measured.size() < kScans) return;
    if (!sensor.mute_scans) silent_since = line.now;
    sensor.mute_scans = true;
    if (line.now - silent_since > 300ms) hand_overs->ending.devices_closing = true;
  };
  ScanWorker worker(*hand_overs, hand_overs->front, true,
                    std::make_unique<hokuyo::Connection>(hokuyo::ConnectionConfig{},
                                                         std::make_unique<mocks::ScriptedConnector>(line)),
                    vitals);
  worker.run();
  const std::uint64_t scans = vitals.run.summary().count;
  EXPECT_GE(scans, kScans - 2) << "the scans did not come";
  EXPECT_EQ(hand_overs->front.to_mapping.committed(), kScanRing);
  EXPECT_EQ(hand_overs->front.to_mapping.rejected(), scans - kScanRing);
}

}  // namespace
}  // namespace topo::daemon

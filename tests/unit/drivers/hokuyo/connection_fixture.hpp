// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "drivers/hokuyo/connection.hpp"
#include "tests/unit/drivers/hokuyo/fake_sensor.hpp"

namespace topo::hokuyo::testing_scip {

/// A connection and a fake sensor on one scripted line and one clock.
class SessionTest : public testing::Test {
 protected:
  void start(const Sample& sample, ConnectionConfig config = {}) {
    sensor = std::make_unique<FakeSensor>(line, sample);
    if (config.name.empty()) config.name = "front";
    connection =
        std::make_unique<Connection>(std::move(config), std::make_unique<mocks::ScriptedConnector>(line));
  }

  /// Steps until `done` or until `limit` of the line's time has passed.
  template <class Done>
  bool run(Done done, types::Duration limit) {
    const types::Stamp until = line.now + limit;
    while (line.now < until) {
      const types::Stamp before = line.now;
      const StepOutcome outcome = connection->step(scan, kStep);
      // Never longer than about the time-out: the whole point of a state machine.
      EXPECT_LE(line.now - before, kStep + std::chrono::milliseconds(2));
      if (outcome == StepOutcome::kScan) ++scans;
      if (outcome == StepOutcome::kChanged) changes.emplace_back(connection->health(), connection->message());
      if (done()) return true;
    }
    return false;
  }
  bool run_scans(int count, types::Duration limit) {
    const int target = scans + count;
    return run([&] { return scans >= target; }, limit);
  }
  bool run_health(Health health, types::Duration limit) {
    return run([&] { return connection->health() == health; }, limit);
  }
  void run_for(types::Duration duration) {
    (void)run([] { return false; }, duration);
  }

  static constexpr types::Duration kStep = std::chrono::milliseconds(10);
  mocks::ScriptedLine line;
  std::unique_ptr<FakeSensor> sensor;
  std::unique_ptr<Connection> connection;
  types::Scan scan;
  int scans = 0;
  std::vector<std::pair<Health, std::string>> changes;
};

inline const Sample& utm_ew() { return kSamples[0]; }
inline const Sample& utm_usb() { return kSamples[1]; }
inline const Sample& ust() { return kSamples[2]; }
inline const Sample& urg() { return kSamples[3]; }

}  // namespace topo::hokuyo::testing_scip

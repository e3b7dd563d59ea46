// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/monitor.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "daemon/app/device_connectors.hpp"
#include "daemon/app/workers.hpp"

namespace topo::daemon {
namespace {

using io::BusFault;
using std::chrono::seconds;

/// What the threads hand over is written by the test; none of them runs.
class MonitorOf : public ::testing::Test {
 protected:
  void watch(const std::string& base_address) {
    configuration_.base.address = base_address;
    configuration_.front.address = "tcp:localhost:10940";
    auto workers = Workers::make(configuration_, *hand_overs_, device_connectors(nullptr));
    ASSERT_TRUE(workers) << workers.error().message;
    workers_ = std::move(*workers);
    monitor_ = std::make_unique<Monitor>(configuration_, *hand_overs_, *workers_);
  }
  void report_passive(std::uint64_t times, types::Stamp now) {
    DeviceReport report;
    report.bus[BusFault::kPassive] = times;
    hand_overs_->base.device.store(report);
    monitor_->update(now);
  }
  [[nodiscard]] Json base_counters() const { return monitor_->status()["devices"]["base"]["counters"]; }

  Configuration configuration_;
  std::unique_ptr<HandOvers> hand_overs_ = std::make_unique<HandOvers>();
  std::unique_ptr<Workers> workers_;
  std::unique_ptr<Monitor> monitor_;
};

TEST_F(MonitorOf, ABaseOnCanTellsWhatGoesWrongOnTheBus) {
  watch("can:no-such-can:0");
  const types::Stamp begin{seconds(100)};
  report_passive(3, begin);
  EXPECT_EQ(base_counters()["bus"]["error_passive"], 3);
  EXPECT_EQ(base_counters()["bus"].size(), io::kBusFaults);
  report_passive(5, begin + seconds(1));
  ASSERT_TRUE(monitor_->facts().can);
  EXPECT_EQ(monitor_->facts().can->faults_lately[BusFault::kPassive], 2U);
  // What is long ago is counted and no finding any more.
  for (int s = 2; s < 30; ++s) report_passive(5, begin + seconds(s));
  EXPECT_EQ(base_counters()["bus"]["error_passive"], 5);
  EXPECT_EQ(monitor_->facts().can->faults_lately, io::BusFaults{});
}

TEST_F(MonitorOf, ADeviceThatHasNotBeenHeardOfIsStarting) {
  watch("tcp:localhost:8101");
  EXPECT_EQ(monitor_->device_obstacle(), "base is not ready: starting");
}

TEST_F(MonitorOf, ABaseThatIsNotThereRefusesTheHandToo) {
  watch("tcp:localhost:8101");
  EXPECT_EQ(monitor_->base_obstacle(), "base is not ready: starting");
  DeviceReport report;
  report.state = "disconnected";
  report.message = "nothing answers";
  hand_overs_->base.device.store(report);
  monitor_->update(types::Stamp{seconds(100)});
  EXPECT_EQ(monitor_->base_obstacle(), "base is not ready: disconnected: nothing answers");
  report.working = true;
  hand_overs_->base.device.store(report);
  monitor_->update(types::Stamp{seconds(101)});
  EXPECT_EQ(monitor_->base_obstacle(), "base is not ready: it takes no commands yet");
  // On trial it is no base to explore with, and one to turn by hand.
  report.working = false;
  report.state = "on trial";
  BaseReport ready;
  ready.ready = true;
  hand_overs_->base.device.store(report);
  hand_overs_->base.report.store(ready);
  monitor_->update(types::Stamp{seconds(102)});
  EXPECT_EQ(monitor_->base_obstacle(), "");
  EXPECT_NE(monitor_->device_obstacle(), "");
}

TEST_F(MonitorOf, WhatIsAssumedOfADeviceIsInTheHealth) {
  watch("tcp:localhost:8101");
  DeviceReport report;
  report.assumed = "\"p3dx-sh-lms1xx\" is driven as p3dx-sh";
  hand_overs_->base.device.store(report);
  monitor_->update(types::Stamp{seconds(100)});
  EXPECT_EQ(monitor_->health()["assumed"], Json::array({"base: \"p3dx-sh-lms1xx\" is driven as p3dx-sh"}));
  EXPECT_EQ(monitor_->facts().devices[0].assumed, "\"p3dx-sh-lms1xx\" is driven as p3dx-sh");
}

TEST_F(MonitorOf, ABaseOnASerialPortHasNoBus) {
  watch("tcp:localhost:8101");
  report_passive(0, types::Stamp{seconds(100)});
  EXPECT_FALSE(base_counters().contains("bus"));
  EXPECT_FALSE(monitor_->facts().can);
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/mapping_worker.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "drivers/io/posix.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

class MappingWorkerTest : public ::testing::Test {
 protected:
  ~MappingWorkerTest() override {
    hand_overs->ending.stopping = true;
    hand_overs->ending.readers_gone = true;
    hand_overs->mapping.wakeup.post();
    thread.join();
  }

  std::unique_ptr<HandOvers> hand_overs = std::make_unique<HandOvers>();
  Vitals vitals{"mapping"};
  MappingWorker worker{*hand_overs, slam::MapperParams{}, {}, vitals};
  std::thread thread{[this] { worker.run(); }};
};

TEST_F(MappingWorkerTest, BeatsAndSkipsWhileItNeverCatchesUp) {
  types::Odometry odometry;
  const types::Stamp limit = io::monotonic_now() + 60s;
  // As from a base and a scanner that are faster than this machine maps: the rings are never seen empty.
  while (vitals.beats.load() < 20 && io::monotonic_now() < limit) {
    while (hand_overs->base.odometry.try_push(odometry)) odometry.stamp += 1ms;
    while (types::Scan* scan = hand_overs->front.to_mapping.try_acquire()) {
      scan->beams = 0;
      scan->first_beam = odometry.stamp;
      hand_overs->front.to_mapping.commit();
    }
    hand_overs->mapping.wakeup.post();
  }
  EXPECT_GE(vitals.beats.load(), 20U) << "the service manager would take it for dead";
  EXPECT_GT(hand_overs->front.to_mapping.skipped(), 0U);
}

TEST_F(MappingWorkerTest, ReportsTheScansThatItHadNoOdometryFor) {
  constexpr std::uint64_t kScans = 3;
  for (std::uint64_t i = 0; i < kScans; ++i) {
    types::Scan* scan = hand_overs->front.to_mapping.try_acquire();
    ASSERT_NE(scan, nullptr);
    scan->beams = 0;
    hand_overs->front.to_mapping.commit();
  }
  hand_overs->mapping.wakeup.post();
  const types::Stamp limit = io::monotonic_now() + 60s;
  std::uint64_t lost = 0;
  while (lost < kScans && io::monotonic_now() < limit) {
    if (const auto* report = hand_overs->mapping.report.take_new(); report != nullptr)
      lost = report->losses.without_odometry;
    else
      std::this_thread::yield();
  }
  EXPECT_EQ(lost, kScans);
}

}  // namespace
}  // namespace topo::daemon

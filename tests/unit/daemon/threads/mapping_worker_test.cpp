// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/mapping_worker.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <thread>

#include "drivers/io/posix.hpp"
#include "tests/mocks/flat_world.hpp"

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

/// A session of one room in which the robot is believed, while its scanner sees a corridor.
TEST_F(MappingWorkerTest, AMapThatDoesNotMatchStopsTheBase) {
  std::mt19937 random{1};
  const mocks::FlatWorld room = mocks::two_rooms();
  mocks::FlatWorld corridor;
  corridor.box(0.0, 0.0, 31.0, 2.2);
  const mocks::ScannerOptions options{541, 4.7, 30.0, 0.01};
  const auto stamp_at = [](int i) { return types::stamp_from_seconds(1.0 + 0.1 * i); };
  pipeline::MappingState made{slam::MapperParams{}, slam::Origin{1, 1}};
  types::Odometry odometry{stamp_at(0), {}, {}};
  const types::Scan first = mocks::take_scan(room, {1.5, 1.5, 0.0}, stamp_at(0), options, random);
  (void)pipeline::mapping_step(made, {{&odometry, 1}, &first, nullptr});
  const slam::Session session = made.mapper().session();
  ASSERT_FALSE(session.keyframes.empty());
  const auto hand_over = [&](std::unique_ptr<pipeline::MappingState> state) {
    hand_overs->mapping.take_over.try_acquire()->content = std::move(state);
    hand_overs->mapping.take_over.commit();
    hand_overs->mapping.wakeup.post();
  };
  hand_over(std::make_unique<pipeline::MappingState>(
      slam::MapperParams{}, session, slam::Arrival{made.cloud(), {}, {}}, slam::Origin{1, 2}));
  const types::Stamp limit = io::monotonic_now() + 60s;
  MappingReport report;
  const auto wait_until = [&](auto pleases) {
    while (!pleases() && io::monotonic_now() < limit) {
      if (const auto* newer = hand_overs->mapping.report.take_new(); newer != nullptr) report = *newer;
      std::this_thread::yield();
    }
    return pleases();
  };
  ASSERT_TRUE(wait_until([&] { return report.trial.verdict == slam::TrialVerdict::kRunning; }));
  EXPECT_EQ(hand_overs->place.now(), types::PlaceStanding::kKnown);
  for (int i = 1; i <= 60; ++i) {
    odometry.stamp = stamp_at(i);
    odometry.T_odom_base = types::Transform2<types::Odom, types::Base>(0.1 * i, 0.0, 0.0);
    ASSERT_TRUE(wait_until([&] { return hand_overs->base.odometry.try_push(odometry); }));
    types::Scan* scan = hand_overs->front.to_mapping.try_acquire();
    ASSERT_NE(scan, nullptr);
    *scan = mocks::take_scan(corridor, {5.0 + 0.1 * i, 1.1, 0.0}, stamp_at(i), options, random);
    hand_overs->front.to_mapping.commit();
    hand_overs->mapping.wakeup.post();
    ASSERT_TRUE(wait_until([&] { return hand_overs->front.to_mapping.size() == 0; }));
  }
  ASSERT_TRUE(wait_until([&] { return report.trial.verdict == slam::TrialVerdict::kDropped; }));
  EXPECT_EQ(hand_overs->place.now(), types::PlaceStanding::kDropped);
  hand_over(std::make_unique<pipeline::MappingState>(slam::MapperParams{}, slam::Origin{1, 3}));
  ASSERT_TRUE(wait_until([&] { return report.map == 3; }));
  EXPECT_EQ(report.trial.verdict, slam::TrialVerdict::kNone);
  EXPECT_EQ(hand_overs->place.now(), types::PlaceStanding::kKnown) << "main says what it is";
}

TEST(PlaceHandOver, ADropOfMappingGoesBeforeTheWordOfMain) {
  using types::PlaceStanding;
  PlaceHandOver place;
  EXPECT_EQ(place.now(), PlaceStanding::kKnown);
  place.dropped = true;
  for (const PlaceStanding standing :
       {PlaceStanding::kKnown, PlaceStanding::kUnknown, PlaceStanding::kProposed}) {
    place.standing = standing;
    EXPECT_EQ(place.now(), PlaceStanding::kDropped);
  }
  place.dropped = false;
  EXPECT_EQ(place.now(), PlaceStanding::kProposed);
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/doubt_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <memory>
#include <random>

#include "core/pipeline/mapping_step.hpp"
#include "drivers/io/posix.hpp"
#include "tests/mocks/flat_world.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

/// The test is main and the mapping thread. The robot goes 1.3 m along a room.
class DoubtWatchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    drive(0, 16);
    report.matched = 16;
    ASSERT_GE(report.keyframes, 3U);
    ASSERT_TRUE(files.start("files"));
  }
  /// Scans [first, last) of the drive, and a map that is told.
  void drive(int first, int last) {
    for (int i = first; i < last; ++i) {
      std::mt19937 random(static_cast<unsigned>(i));
      const types::Stamp stamp = types::stamp_from_seconds(0.1 * (i + 1));
      const types::Odometry odometry{
          stamp, types::Transform2<types::Odom, types::Base>(0.09 * i, 0.0, 0.0), {}};
      const types::Scan scan = mocks::take_scan(world, {1.5 + 0.09 * i, 1.5, 0.0}, stamp, {}, random);
      (void)pipeline::mapping_step(state, {{&odometry, 1}, &scan, nullptr});
    }
    tell();
  }
  void tell() {
    hand_overs->mapping.map->publish(state.make_snapshot());
    report.keyframes = state.mapper().keyframes().size();
    report.revision = state.revision();
  }
  void TearDown() override {
    files.stop();
    watcher.reset();
    hand_overs->mapping.map.reset();  // its snapshots hold nodes of the state
  }
  /// Ticks and answers as mapping until a look has ended; false when none has begun.
  bool look(types::Duration later = {}) {
    watch.tick(io::monotonic_now() + later, report);
    if (!watch.is_looking()) return false;
    const types::Stamp limit = io::monotonic_now() + 60s;
    while (watch.is_looking() && io::monotonic_now() < limit) {
      serve_desk(hand_overs->files_desk, state, report.map);
      if (io::wait_for(files.fd(), POLLIN, 1ms) > 0) files.collect();
    }
    return !watch.is_looking() && watch.found().revision == state.revision();
  }
  /// Where planning is to look again.
  std::vector<types::Vector2> told() {
    const auto* places = hand_overs->to_planning.doubted.read();
    return places == nullptr ? std::vector<types::Vector2>{} : *places;
  }

  mocks::FlatWorld world = mocks::two_rooms();
  Configuration configuration;
  std::unique_ptr<HandOvers> hand_overs = std::make_unique<HandOvers>();
  pipeline::MappingState state{mapper_params(configuration)};
  MappingReport report;
  Background files;
  SessionClient client{hand_overs->files_desk, hand_overs->mapping.wakeup};
  std::unique_ptr<DoubtWatch> watcher = std::make_unique<DoubtWatch>(
      *hand_overs, MapDoubter(*hand_overs, client, 0, mapper_params(configuration).graph), files);
  DoubtWatch& watch = *watcher;
};

TEST_F(DoubtWatchTest, AMapOfMatchesIsNotDoubted) {
  EXPECT_TRUE(watch.json().is_null());
  ASSERT_TRUE(look());
  EXPECT_EQ(watch.text(), "");
  EXPECT_EQ(watch.json()["revision"], report.revision);
  EXPECT_EQ(watch.json()["why"], "");
  EXPECT_TRUE(told().empty());
}

TEST_F(DoubtWatchTest, TheScansOfTheRunCount) {
  report.lost = 4;
  ASSERT_TRUE(look());
  EXPECT_THAT(watch.text(), HasSubstr("lost in 4 of 20 scans"));
  EXPECT_GT(watch.json()["figure"], 1.0);
}

TEST_F(DoubtWatchTest, AMapIsLookedAtAgainWhenItChangedAndNotTooOften) {
  ASSERT_TRUE(look());
  drive(16, 24);
  ASSERT_NE(watch.found().revision, report.revision);
  EXPECT_FALSE(look()) << "too soon";
  EXPECT_TRUE(look(1h));
  EXPECT_FALSE(look(2h)) << "the same map";
}

TEST_F(DoubtWatchTest, TheDoubtOfAMapEndsWithIt) {
  report.lost = 4;
  ASSERT_TRUE(look());
  ASSERT_NE(watch.text(), "");
  ++report.map;
  watch.tick(io::monotonic_now(), report);
  EXPECT_EQ(watch.text(), "");
  EXPECT_TRUE(watch.json().is_null());
}

/// Home is before it: planning has nothing to look at again.
TEST_F(DoubtWatchTest, DoubtsATurnThatOdometryAloneCarries) {
  types::Stamp stamp = types::stamp_from_seconds(2.0);
  const types::Scan dark = [&] {
    std::mt19937 random{2};
    types::Scan scan = mocks::take_scan(world, {2.8, 1.5, 0.0}, stamp, {}, random);
    for (std::size_t i = 0; i < scan.beams; ++i) scan.range_m[i] = types::kInvalid;
    return scan;
  }();
  for (int i = 1; i <= 40; ++i) {
    types::Scan scan = dark;
    stamp = types::stamp_from_seconds(2.0 + 0.1 * i);
    scan.first_beam = scan.arrival = stamp;
    const types::Odometry odometry{
        stamp, types::Transform2<types::Odom, types::Base>(1.35, 0.0, 0.1 * i), {}};
    (void)pipeline::mapping_step(state, {{&odometry, 1}, &scan, nullptr});
  }
  tell();
  ASSERT_TRUE(look(1h));
  EXPECT_THAT(watch.text(), HasSubstr("odometry alone says how the robot turned"));
  EXPECT_TRUE(told().empty());
}

TEST(StandsBeside, AreTheNearestOfTheOwnWay) {
  const std::vector<types::Se2> poses{{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}, {5.2, 0.0, 0.0}, {9.0, 0.0, 0.0}};
  const std::vector<std::size_t> own_way{0, 1, 3};  // the third is a team-mate's
  const std::vector<slam::RevisitRegion> regions{{{5.4, 1.0}, 300, 0}, {{9.0, 9.0}, 300, 0}};
  const auto stands = stands_beside(regions, poses, own_way);
  ASSERT_EQ(stands.size(), 2U);
  EXPECT_EQ(stands[0], types::Vector2(5.0, 0.0));
  EXPECT_EQ(stands[1], types::Vector2(9.0, 0.0));
  EXPECT_TRUE(stands_beside(regions, poses, {}).empty());
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/threads/journal_worker.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <random>
#include <thread>

#include "core/pipeline/mapping_step.hpp"
#include "daemon/logging/event_catalogue.hpp"
#include "daemon/session/folder.hpp"
#include "daemon/session/session_reader.hpp"
#include "drivers/io/posix.hpp"
#include "tests/mocks/flat_world.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

/// The mapping thread's part: a state that grows, and its desk.
class JournalWorkerTest : public ::testing::Test {
 protected:
  void SetUp() override { begin_map(); }
  void TearDown() override { stop(); }

  void begin_map() { state = std::make_unique<pipeline::MappingState>(slam::MapperParams{}); }

  /// Drives on by `keyframes` keyframes' way and a little.
  void drive(int keyframes) {
    for (int i = 0; i < 5 * keyframes; ++i, ++scans) {
      const types::Se2 pose{1.5 + 0.09 * scans, 1.5, 0.0};
      const types::Stamp stamp = types::stamp_from_seconds(0.1 * (scans + 1));
      const types::Odometry odometry{
          stamp, types::Transform2<types::Odom, types::Base>(0.09 * scans, 0.0, 0.0), {}};
      const types::Scan scan = mocks::take_scan(world, pose, stamp, {}, random);
      (void)pipeline::mapping_step(*state, {{&odometry, 1}, &scan, nullptr});
    }
  }

  void start(JournalSettings settings) {
    settings.period = 5ms;
    settings.params_hash = 9;
    worker = std::make_unique<JournalWorker>(*hand_overs, std::move(settings), vitals);
    thread = std::thread([this] { worker->run(); });
  }
  void stop() {
    hand_overs->ending.stopping = true;
    if (!thread.joinable()) return;
    std::thread joiner([this] { thread.join(), joined = true; });
    while (!joined) serve();
    joiner.join();
  }
  void serve() {
    serve_desk(hand_overs->journal.desk, *state, map);
    std::this_thread::sleep_for(1ms);  // as the mapping thread between two scans; who calls has the deadline
  }
  /// Serves until the journal's report pleases.
  template <class Pleases>
  bool until(Pleases pleases) {
    const types::Stamp limit = io::monotonic_now() + 60s;
    while (io::monotonic_now() < limit) {
      serve();
      const JournalReport* report = hand_overs->journal.report.read();
      if (report != nullptr && pleases(*report)) return true;
    }
    return false;
  }
  bool until_all_is_kept() {
    const std::size_t all = state->mapper().keyframes().size();
    return until([all](const JournalReport& r) { return !r.failing && r.keyframes == all; });
  }
  std::vector<SessionEntry> journals() const { return *list_sessions(folder.str()); }

  testing::TempDir folder;
  mocks::FlatWorld world = mocks::two_rooms();
  std::mt19937 random{1};
  std::unique_ptr<pipeline::MappingState> state;
  std::uint64_t map = 1;
  int scans = 0;
  std::unique_ptr<HandOvers> hand_overs = std::make_unique<HandOvers>();
  Vitals vitals{"journal"};
  std::unique_ptr<JournalWorker> worker;
  std::thread thread;
  std::atomic<bool> joined{false};
};

TEST_F(JournalWorkerTest, KeepsEveryKeyframeAndClosesInOrder) {
  start({folder.str()});
  for (int i = 0; i < 4; ++i) {
    drive(3);
    ASSERT_TRUE(until_all_is_kept());
    const auto loaded = load_session(journals().at(0).path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->session.keyframes.size(), state->mapper().keyframes().size());
    EXPECT_EQ(loaded->params_hash, 9U);
    EXPECT_FALSE(loaded->closed);
  }
  drive(2);  // not asked for yet: it comes at the end
  stop();
  const auto loaded = load_session(journals().at(0).path);
  ASSERT_TRUE(loaded);
  EXPECT_TRUE(loaded->closed);
  ASSERT_EQ(loaded->session.keyframes.size(), state->mapper().keyframes().size());
  for (std::size_t i = 0; i < loaded->session.poses.size(); ++i)
    EXPECT_EQ(loaded->session.poses[i], state->mapper().poses()[i]);
}

TEST_F(JournalWorkerTest, ARobotThatHasNotMovedMakesNoFile) {
  start({folder.str()});
  drive(0);
  const types::Stamp limit = io::monotonic_now() + 100ms;
  while (io::monotonic_now() < limit) serve();
  stop();
  EXPECT_TRUE(journals().empty());
}

TEST_F(JournalWorkerTest, AnotherMapGetsAJournalOfItsOwn) {
  start({folder.str(), 2s, 2});
  for (int i = 0; i < 3; ++i) {
    drive(4);
    ASSERT_TRUE(until_all_is_kept());
    const std::string name = hand_overs->journal.report.read()->name.str();
    begin_map();
    scans = 0;
    ++map;
    drive(4);
    ASSERT_TRUE(until([&](const JournalReport& r) { return r.name.view() != name; }));
    ASSERT_TRUE(until_all_is_kept());
  }
  EXPECT_EQ(journals().size(), 2U) << "older ones are removed";
  EXPECT_TRUE(load_session(journals().at(0).path)->closed);
}

// The map that was kept goes only when its successor is on the disk.
TEST_F(JournalWorkerTest, OldJournalsGoBeyondTheQuotaAndItIsTold) {
  (void)folder.write("journal-20200101T000000Z.session", std::string(3'000'000, 'x'));
  (void)folder.write("kept.session", std::string(3'000'000, 'x'));
  JournalSettings settings{folder.str()};
  settings.quota_bytes = 2'000'000;
  start(settings);
  drive(0);
  const types::Stamp limit = io::monotonic_now() + 50ms;
  while (io::monotonic_now() < limit) serve();
  EXPECT_EQ(journals().size(), 2U) << "there is no map to take its place yet";
  drive(4);
  ASSERT_TRUE(until_all_is_kept());
  ASSERT_EQ(journals().size(), 2U);
  EXPECT_EQ(journals()[0].name, hand_overs->journal.report.read()->name.view());
  EXPECT_EQ(journals()[1].name, "kept");
  const auto* event = vitals.events.front();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(format_event(*event), "1 old journals of 3 MB are removed: session.quota_mb is 2");
}

TEST_F(JournalWorkerTest, HeldBackItWritesNothing) {
  hand_overs->journal.held = true;
  start({folder.str()});
  drive(4);
  const types::Stamp limit = io::monotonic_now() + 100ms;
  while (io::monotonic_now() < limit) serve();
  EXPECT_TRUE(journals().empty());
  hand_overs->journal.held = false;
  EXPECT_TRUE(until_all_is_kept());
  EXPECT_EQ(journals().size(), 1U);
}

TEST_F(JournalWorkerTest, AMissingDiskIsToldCountedAndCaughtUpWith) {
  const std::string later = folder.file("later");
  start({later});
  drive(4);
  ASSERT_TRUE(until([](const JournalReport& r) { return r.failing && r.failures >= 3; }));
  const auto* event = vitals.events.front();
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->id, static_cast<std::uint16_t>(EventId::kJournalFailed));
  EXPECT_EQ(format_event(*event),
            "the session is not being kept, 1 times since the start: No such file or directory");
  drive(3);
  std::filesystem::create_directory(later);
  ASSERT_TRUE(until_all_is_kept());
  EXPECT_EQ(list_sessions(later)->size(), 1U);
}

TEST_F(JournalWorkerTest, TheMissionLogGoesOnWhileTheMapIsHeldBack) {
  hand_overs->journal.held = true;
  for (int i = 1; i <= 6; ++i)
    (void)folder.write("log-2020010" + std::to_string(i) + "T000000Z.jsonl", "{}\n");
  start({folder.str()});
  ASSERT_TRUE(hand_overs->journal.log.add("{\"t_s\":1}\n"));
  ASSERT_TRUE(until([&](const JournalReport&) { return mission_logs(folder.str()).size() == 5; }))
      << "as many as journals are kept";
  ASSERT_TRUE(hand_overs->journal.log.add("{\"t_s\":2}\n"));
  stop();
  EXPECT_EQ(testing::read_all(mission_logs(folder.str()).back().path), "{\"t_s\":1}\n{\"t_s\":2}\n");
}

TEST_F(JournalWorkerTest, LinesWaitForAMissingDisk) {
  const std::string later = folder.file("later");
  ASSERT_TRUE(hand_overs->journal.log.add("{\"t_s\":1}\n"));
  start({later});
  ASSERT_TRUE(until([](const JournalReport& r) { return r.failing && r.failures >= 3; }));
  ASSERT_TRUE(hand_overs->journal.log.add("{\"t_s\":2}\n"));
  std::filesystem::create_directory(later);
  ASSERT_TRUE(until([&](const JournalReport& r) { return !r.failing; }));
  stop();
  ASSERT_EQ(mission_logs(later).size(), 1U);
  EXPECT_EQ(testing::read_all(mission_logs(later)[0].path), "{\"t_s\":1}\n{\"t_s\":2}\n");
}

}  // namespace
}  // namespace topo::daemon

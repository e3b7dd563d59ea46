// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/session_control.hpp"

#include <gtest/gtest.h>

#include <poll.h>
#include <filesystem>

#include <random>

#include "core/pipeline/mapping_step.hpp"
#include "daemon/session/session_writer.hpp"
#include "drivers/io/posix.hpp"
#include "tests/mocks/flat_world.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using namespace std::chrono_literals;

/// The test is main and, where it says so, the mapping thread, which is asked before a session is handed
/// over.
class SessionControlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    configuration.session.folder = folder.str();
    configuration.session.resume = "";
    const mocks::FlatWorld world = mocks::two_rooms();
    std::mt19937 random{1};
    for (int i = 0; i < 12; ++i) {
      const types::Stamp stamp = types::stamp_from_seconds(0.1 * (i + 1));
      const types::Odometry odometry{
          stamp, types::Transform2<types::Odom, types::Base>(0.09 * i, 0.0, 0.0), {}};
      const types::Scan scan = mocks::take_scan(world, {1.5 + 0.09 * i, 1.5, 0.0}, stamp, {}, random);
      (void)pipeline::mapping_step(state, {{&odometry, 1}, &scan, nullptr});
    }
    const slam::Mapper& mapper = state.mapper();
    const slam::Session session{{mapper.keyframes().begin(), mapper.keyframes().end()},
                                {mapper.poses().begin(), mapper.poses().end()},
                                {mapper.edges().begin(), mapper.edges().end()}};
    ASSERT_FALSE(session.keyframes.empty());
    ASSERT_TRUE(save_session(session_path(folder.str(), "room"), session, 1));
    ASSERT_TRUE(files.start("files"));
  }

  void load(SessionControl& control, const std::string& name) {
    control.load(name, types::Se2{0.9, 0.0, 0.0}, [this](const types::Result<Json>& r) { answer = r; });
  }
  template <class Pleases>
  bool serve_until(Pleases pleases) {
    const types::Stamp limit = io::monotonic_now() + 60s;
    while (!pleases() && io::monotonic_now() < limit) {
      serve_desk(hand_overs->files_desk, state, map);
      if (io::wait_for(files.fd(), POLLIN, 1ms) > 0) files.collect();
    }
    return pleases();
  }
  bool serve_until_answered() {
    return serve_until([this] { return answer.has_value(); });
  }

  bool serve_until_handed_over() {
    return serve_until([this] { return hand_overs->mapping.take_over.front() != nullptr; });
  }
  void take_over() {
    hand_overs->mapping.take_over.front()->content->adopt();
    hand_overs->mapping.take_over.front()->content.reset();
    hand_overs->mapping.take_over.pop();
    ++map;
  }

  testing::TempDir folder;
  Configuration configuration;
  std::unique_ptr<HandOvers> hand_overs = std::make_unique<HandOvers>();
  pipeline::MappingState state{mapper_params(configuration)};
  std::uint64_t map = 1;
  std::optional<types::Result<Json>> answer;
  Background files;
};

TEST_F(SessionControlTest, ASessionIsHandedToTheMappingThread) {
  SessionControl control(configuration, *hand_overs, files);
  load(control, "room");
  EXPECT_EQ(control.obstacle(), "a session is being loaded");
  ASSERT_TRUE(serve_until_handed_over());
  EXPECT_FALSE(control.begin_anew()) << "it is too late";
  take_over();
  ASSERT_TRUE(serve_until_answered());
  EXPECT_TRUE(*answer) << answer->error().message;
  EXPECT_EQ(control.obstacle(), "");
}

TEST_F(SessionControlTest, ANewMapIsNotReplacedByASessionStillSearched) {
  SessionControl control(configuration, *hand_overs, files);
  load(control, "room");
  ASSERT_TRUE(control.begin_anew());
  EXPECT_EQ(control.obstacle(), "");
  ASSERT_TRUE(serve_until_answered());
  EXPECT_EQ(hand_overs->mapping.take_over.front(), nullptr);
  ASSERT_FALSE(*answer);
  EXPECT_EQ(answer->error().code, types::Errc::kBusy);
}

TEST_F(SessionControlTest, OneThatWasDroppedKeepsNoOtherOut) {
  SessionControl control(configuration, *hand_overs, files);
  std::optional<types::Result<Json>> dropped;
  control.load("room", {}, [&](const types::Result<Json>& r) { dropped = r; });
  ASSERT_TRUE(control.begin_anew());
  load(control, "room");  // on the operator's word; the one before is in hand still
  EXPECT_EQ(control.obstacle(), "a session is being loaded");
  ASSERT_TRUE(serve_until_handed_over());
  ASSERT_TRUE(dropped);
  EXPECT_FALSE(*dropped);
  EXPECT_EQ(control.obstacle(), "a session is being loaded") << "the end of the one before is not its end";
  EXPECT_FALSE(control.begin_anew()) << "nor does it make it one that can be dropped";
  load(control, "room");
  ASSERT_TRUE(answer && !*answer) << "one at a time";
  answer.reset();
  take_over();
  ASSERT_TRUE(serve_until_answered());
  EXPECT_TRUE(*answer) << answer->error().message;
}

TEST_F(SessionControlTest, WhatWasBegunAnewIsNotOvertakenByTheSessionToResume) {
  configuration.session.resume = "room";
  SessionControl control(configuration, *hand_overs, files);
  control.tick(io::monotonic_now(), true);
  EXPECT_NE(control.obstacle(), "");
  ASSERT_TRUE(control.begin_anew());
  EXPECT_EQ(control.obstacle(), "");
  // Its job comes first.
  control.save("after", [this](const types::Result<Json>& r) { answer = r; });
  ASSERT_TRUE(serve_until_answered());
  EXPECT_EQ(hand_overs->mapping.take_over.front(), nullptr);
  EXPECT_EQ(control.obstacle(), "");
}

// An empty journal, as a loss of power leaves it, neither refuses missions nor hides the one before.
TEST_F(SessionControlTest, AnEmptyNewestJournalIsPassedOver) {
  std::filesystem::rename(session_path(folder.str(), "room"), session_path(folder.str(), "journal-1"));
  (void)folder.write("journal-2.session", "");
  configuration.session.resume = "last";
  SessionControl control(configuration, *hand_overs, files);
  control.tick(io::monotonic_now(), true);
  EXPECT_NE(control.obstacle(), "");
  ASSERT_TRUE(serve_until_handed_over());
  take_over();
  EXPECT_TRUE(serve_until([&] { return control.obstacle().empty(); })) << control.obstacle();
}

TEST_F(SessionControlTest, WithoutAUsableJournalTheOperatorDecides) {
  (void)folder.write("journal-2.session", "");
  configuration.session.resume = "last";
  SessionControl control(configuration, *hand_overs, files);
  control.tick(io::monotonic_now(), true);
  ASSERT_TRUE(serve_until([&] { return control.obstacle().find("the file is empty") != std::string::npos; }))
      << control.obstacle();
  EXPECT_EQ(hand_overs->mapping.take_over.front(), nullptr);
}

TEST_F(SessionControlTest, ALoadThatFailsLeavesNoObstacleBehindThatIsGone) {
  configuration.session.resume = "room";
  SessionControl control(configuration, *hand_overs, files);
  EXPECT_NE(control.obstacle(), "") << "nobody has looked for it yet";
  load(control, "nowhere");
  ASSERT_TRUE(control.begin_anew());
  ASSERT_TRUE(serve_until_answered());
  EXPECT_FALSE(*answer);
  EXPECT_EQ(control.obstacle(), "");
}

}  // namespace
}  // namespace topo::daemon

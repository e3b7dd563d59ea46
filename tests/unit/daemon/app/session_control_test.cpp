// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/app/session_control.hpp"

#include <gmock/gmock.h>
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
using ::testing::HasSubstr;
using types::PlaceStanding;

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
    report.map = ++map;
    report.trial.verdict = slam::TrialVerdict::kRunning;
  }
  /// Main's tick; true when a place was dropped.
  bool tick(SessionControl& control, types::Duration later = {}) {
    return control.tick(io::monotonic_now() + later, report);
  }
  bool serve_until_proposed(SessionControl& control) {
    return serve_until([&] { return control.standing() == types::PlaceStanding::kProposed; });
  }
  void confirm(SessionControl& control, const std::optional<types::Se2>& pose) {
    answer.reset();
    control.confirm(pose, [this](const types::Result<Json>& r) { answer = r; });
  }
  [[nodiscard]] bool is_journal_held() const { return hand_overs->journal.held.load(); }

  testing::TempDir folder;
  Configuration configuration;
  std::unique_ptr<HandOvers> hand_overs = std::make_unique<HandOvers>();
  MappingReport report = [] {
    MappingReport some;
    some.keyframes = 1;
    return some;
  }();
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
  (void)control.tick(io::monotonic_now(), report);
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
  (void)control.tick(io::monotonic_now(), report);
  EXPECT_NE(control.obstacle(), "");
  ASSERT_TRUE(serve_until_proposed(control)) << control.obstacle();
  EXPECT_THAT(control.obstacle(), HasSubstr("session journal-1 is a proposal"));
}

TEST_F(SessionControlTest, WithoutAUsableJournalTheOperatorDecides) {
  (void)folder.write("journal-2.session", "");
  configuration.session.resume = "last";
  SessionControl control(configuration, *hand_overs, files);
  (void)control.tick(io::monotonic_now(), report);
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

// Whether the session was resumed or loaded by hand: the map shows too little to be sure of the place.
TEST_F(SessionControlTest, APlaceInASmallMapWaitsForTheOperator) {
  for (const bool by_hand : {false, true}) {
    configuration.session.resume = by_hand ? "" : "room";
    SessionControl control(configuration, *hand_overs, files);
    EXPECT_EQ(control.standing(), by_hand ? PlaceStanding::kKnown : PlaceStanding::kUnknown);
    answer.reset();
    if (by_hand)
      control.load("room", {}, [this](const types::Result<Json>& r) { answer = r; });
    else
      (void)tick(control);
    ASSERT_TRUE(serve_until_proposed(control)) << control.obstacle();
    EXPECT_EQ(hand_overs->mapping.take_over.front(), nullptr) << "nothing is joined to the older map";
    EXPECT_TRUE(!by_hand || (**answer)["proposal"] == true);
    EXPECT_THAT(control.obstacle(), HasSubstr("too little of the building"));
    EXPECT_THAT(control.obstacle(), HasSubstr("topoctl session confirm"));
    EXPECT_EQ(control.trouble(), control.obstacle());
    EXPECT_EQ(is_journal_held(), !by_hand) << "the map so far is kept as before";
    ASSERT_TRUE(control.begin_anew());
    EXPECT_EQ(control.standing(), PlaceStanding::kKnown);
    EXPECT_EQ(control.obstacle(), "");
    EXPECT_FALSE(is_journal_held());
  }
}

TEST_F(SessionControlTest, AConfirmedPlaceIsKnownAndOnTrial) {
  configuration.session.resume = "room";
  SessionControl control(configuration, *hand_overs, files);
  (void)tick(control);
  ASSERT_TRUE(serve_until_proposed(control)) << control.obstacle();
  confirm(control, {});
  ASSERT_TRUE(serve_until_handed_over());
  EXPECT_EQ(control.standing(), PlaceStanding::kUnknown) << "the plans are of the map before";
  take_over();
  ASSERT_TRUE(serve_until_answered());
  ASSERT_TRUE(*answer) << answer->error().message;
  EXPECT_EQ(control.obstacle(), "");
  EXPECT_FALSE(tick(control));
  EXPECT_EQ(control.standing(), PlaceStanding::kUnknown);
  EXPECT_FALSE(tick(control, 2s));
  EXPECT_EQ(control.standing(), PlaceStanding::kKnown);
  EXPECT_TRUE(is_journal_held()) << "nothing is kept before the first metres match";
  answer.reset();
  control.save("after", [this](const types::Result<Json>& r) { answer = r; });
  ASSERT_TRUE(answer);
  EXPECT_THAT(answer->error().message, HasSubstr("on trial"));
  report.trial.verdict = slam::TrialVerdict::kPassed;
  EXPECT_FALSE(tick(control, 2s));
  EXPECT_FALSE(is_journal_held());
  confirm(control, {});
  ASSERT_TRUE(answer && !*answer) << "there is nothing more to confirm";
  EXPECT_EQ(answer->error().code, types::Errc::kNotFound);
}

TEST_F(SessionControlTest, ADroppedPlaceLeavesAFreshMapAndANeedForAPose) {
  SessionControl control(configuration, *hand_overs, files);
  load(control, "room");
  ASSERT_TRUE(serve_until_handed_over());
  take_over();
  ASSERT_TRUE(serve_until_answered());
  report.trial = {.way_m = 3.0,
                  .matched = 10,
                  .contradicted = 6,
                  .silent = 1,
                  .recent = 0,
                  .recent_count = 0,
                  .verdict = slam::TrialVerdict::kDropped};
  EXPECT_TRUE(tick(control, 2s));
  EXPECT_EQ(control.standing(), PlaceStanding::kDropped);
  EXPECT_THAT(control.obstacle(), HasSubstr("after 3.0 m 10 scans match the older map, 6 contradict it"));
  EXPECT_TRUE(is_journal_held());
  // The map in which the new is joined to the old wrongly is replaced.
  ASSERT_TRUE(serve_until_handed_over());
  EXPECT_TRUE(hand_overs->mapping.take_over.front()->content->mapper().keyframes().empty());
  take_over();
  report.trial = {};
  confirm(control, {});
  ASSERT_TRUE(answer && !*answer);
  EXPECT_EQ(answer->error().code, types::Errc::kInvalidInput) << "a pose is needed";
  EXPECT_FALSE(tick(control, 3s)) << "it is told once";
  EXPECT_EQ(control.standing(), PlaceStanding::kDropped);
  bool taken = false;
  ASSERT_TRUE(serve_until([&] {
    if (!taken) confirm(control, types::Se2{0.9, 0.0, 0.0});
    taken = taken || !answer;  // else refused: the new map is being begun
    return taken;
  }));
  ASSERT_TRUE(serve_until_handed_over());
  take_over();
  ASSERT_TRUE(serve_until_answered());
  EXPECT_TRUE(*answer) << answer->error().message;
  EXPECT_EQ(control.obstacle(), "");
}

TEST_F(SessionControlTest, BegunAnewOnTrialTheMapIsReplaced) {
  SessionControl control(configuration, *hand_overs, files);
  load(control, "room");
  ASSERT_TRUE(serve_until_handed_over());
  take_over();
  ASSERT_TRUE(serve_until_answered());
  ASSERT_TRUE(control.begin_anew());
  EXPECT_NE(control.obstacle(), "");
  EXPECT_FALSE(tick(control, 2s));
  ASSERT_TRUE(serve_until_handed_over());
  EXPECT_TRUE(hand_overs->mapping.take_over.front()->content->mapper().keyframes().empty());
  take_over();
  ASSERT_TRUE(serve_until([&] { return control.standing() == PlaceStanding::kKnown; }));
  EXPECT_EQ(control.obstacle(), "");
  EXPECT_FALSE(is_journal_held());
}

TEST_F(SessionControlTest, AWrongPoseIsRefusedAndTheProposalStays) {
  configuration.session.resume = "room";
  SessionControl control(configuration, *hand_overs, files);
  (void)tick(control);
  ASSERT_TRUE(serve_until_proposed(control)) << control.obstacle();
  const std::string proposed = control.obstacle();
  confirm(control, types::Se2{60.0, 60.0, 0.0});
  ASSERT_TRUE(serve_until_answered());
  EXPECT_FALSE(*answer);
  EXPECT_EQ(control.standing(), PlaceStanding::kProposed);
  EXPECT_EQ(control.obstacle(), proposed);
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/story.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

#include "daemon/session/session_writer.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"

namespace topo::daemon {
namespace {

std::string state(double t_s, int keyframes, const std::string& utc = "2026-01-02T03:04:05Z") {
  return Json{{"kind", "state"}, {"t_s", t_s}, {"utc", utc}, {"map", {{"keyframes", keyframes}}}}.dump() +
         "\n";
}
std::string event(double t_s, const std::string& name) {
  return Json{{"kind", "event"}, {"t_s", t_s}, {"event", name}}.dump() + "\n";
}

TEST(Story, IsTheLinesInOrderOfTime) {
  const Story story = parse_story(state(2, 1) + event(1.5, "ready") + state(1, 0) + state(200'000, 7));
  ASSERT_EQ(story.states.size(), 3U);
  EXPECT_EQ(story.states[0].t_s, 1.0);
  EXPECT_EQ(story.length_s(), 200'000.0) << "a daemon runs for days";
  EXPECT_EQ(keyframes_of(story.states[2].json), 7U);
  ASSERT_EQ(story.events.size(), 1U);
  EXPECT_EQ(story.unread, 0U);
}

TEST(Story, WhatIsNoLineIsCounted) {
  const std::string whole = state(1, 1);
  const Story story =
      parse_story("{}\nnonsense\n[1]\n" + event(-1.0, "early") + Json{{"kind", "state"}}.dump() + "\n" +
                  Json{{"kind", "other"}, {"t_s", 1}}.dump() + "\n" + whole + whole.substr(0, 20));
  EXPECT_EQ(story.states.size(), 1U);
  EXPECT_EQ(story.unread, 7U);
}

RC_GTEST_PROP(Story, AnyTextIsRead, (const std::string& text)) {
  const Story story = of_map(parse_story(text + state(1, 1)), std::nullopt);
  RC_ASSERT(story.states.size() <= 1U);
}

TEST(Story, OfSeveralMapsOfOneDaemonTheOneOfTheJournalIsTaken) {
  const std::string log = event(0.5, "ready") + state(1, 0, "2026-01-02T03:00:01Z") +
                          state(10, 9, "2026-01-02T03:00:10Z") + event(12, "second") +
                          state(20, 1, "2026-01-02T03:00:20Z") + event(21, "late") +
                          state(30, 5, "2026-01-02T03:00:30Z");
  const Story first = of_map(parse_story(log), seconds_of("2026-01-02T03:00:03Z"));
  EXPECT_EQ(first.length_s(), 9.5) << "from the first word of the daemon on";
  ASSERT_EQ(first.events.size(), 1U);
  EXPECT_EQ(first.events[0].t_s, 0.0);
  const Story second = of_map(parse_story(log), seconds_of("2026-01-02T03:00:22Z"));
  EXPECT_EQ(second.length_s(), 10.0);
  ASSERT_EQ(second.events.size(), 1U);
  EXPECT_EQ(second.events[0].json["event"], "late");
  EXPECT_EQ(of_map(parse_story(log), std::nullopt).length_s(), 10.0) << "the last one";
}

TEST(Story, WithoutALogTheKeyframesTellTheWay) {
  const slam::Session session = testing::sample_session(4, 1);
  const auto history = parse_history(*session_bytes(session, 1));
  ASSERT_TRUE(history);
  const Story story = story_of(*history);
  ASSERT_EQ(story.states.size(), 4U);
  EXPECT_DOUBLE_EQ(story.length_s(), 1.5);
  EXPECT_EQ(keyframes_of(story.states[2].json), 3U);
  EXPECT_EQ(story.states[2].json["pose"]["x_m"], session.poses[2].x_m);
}

TEST(Story, WithoutALogItsEndHasWhatMatesSentLast) {
  slam::Session session = testing::sample_session(4, 1);
  for (const std::size_t i : {std::size_t{1}, std::size_t{3}}) {
    slam::Keyframe of_mate = *session.keyframes[i];
    of_mate.id.robot = static_cast<std::uint16_t>(of_mate.id.robot + 1);
    session.keyframes[i] = std::make_shared<const slam::Keyframe>(std::move(of_mate));
  }
  const auto history = parse_history(*session_bytes(session, 1));
  ASSERT_TRUE(history);
  const Story story = story_of(*history);
  ASSERT_EQ(story.states.size(), 2U);
  EXPECT_EQ(keyframes_of(story.states[0].json), 1U);
  EXPECT_EQ(keyframes_of(story.states[1].json), 4U);
}

TEST(Story, AnOlderLogHasTheRobotsOwnKeyframesAlone) {
  slam::Session session = testing::sample_session(6, 1);
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
    slam::Keyframe of_mate = *session.keyframes[i];
    of_mate.id.robot = static_cast<std::uint16_t>(of_mate.id.robot + 1);
    session.keyframes[i] = std::make_shared<const slam::Keyframe>(std::move(of_mate));
  }
  const auto history = parse_history(*session_bytes(session, 1));
  ASSERT_TRUE(history);
  const std::string newer =
      Json{{"kind", "state"}, {"t_s", 5}, {"map", {{"keyframes", 2}, {"keyframes_of_all", 4}}}}.dump();
  const Story story = with_all_keyframes(
      parse_story(state(1, 0) + state(2, 1) + state(3, 2) + state(4, 3) + newer + "\n"), *history);
  std::vector<std::size_t> of_all;
  for (const StoryLine& line : story.states) of_all.push_back(keyframes_of(line.json));
  EXPECT_EQ(of_all, (std::vector<std::size_t>{0, 3, 4, 6, 4}));
  EXPECT_EQ(story.states[1].json["map"]["keyframes"], 1) << "the page shows the robot's own";
}

TEST(SecondsOf, ATimeOfALog) {
  EXPECT_EQ(seconds_of("1970-01-02T00:00:01Z"), 86'401);
  EXPECT_EQ(seconds_of("2026-01-02T03:04:05Z"), 1'767'323'045);
  for (const char* text :
       {"", "2026-01-02", "2026-13-02T03:04:05Z", "2026-01-02T03:04:05Zx", "20260102T030405Z"})
    EXPECT_FALSE(seconds_of(text)) << text;
}

}  // namespace
}  // namespace topo::daemon

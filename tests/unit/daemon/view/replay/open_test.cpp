// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/view/replay/open.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "daemon/session/session_writer.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

class OpenReplayTest : public ::testing::Test {
 protected:
  void put_session(const std::string& name) {
    ASSERT_TRUE(save_session(folder.file(name), testing::sample_session(3, 1), 1));
  }
  void put_log(const std::string& name, const std::string& utc) {
    std::ofstream(folder.file(name))
        << Json{{"kind", "state"}, {"t_s", 1}, {"utc", utc}, {"state", name}}.dump() << "\n";
  }
  testing::TempDir folder;
};

TEST_F(OpenReplayTest, AJournalHasTheLogOfItsDaemon) {
  put_session("journal-20260102T030405Z.session");
  put_session("journal-20260103T030405Z-001.session");
  put_log("log-20260101T000000Z.jsonl", "2026-01-01T00:00:00Z");
  put_log("log-20260102T030407Z.jsonl", "2026-01-02T03:04:07Z");
  put_log("log-20260103T030301Z.jsonl", "2026-01-03T03:03:01Z");
  const auto first = load_played(folder.file("journal-20260102T030405Z.session"));
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_THAT(first->log, EndsWith("log-20260102T030407Z.jsonl"));
  EXPECT_EQ(first->map.keyframes().size(), 3U);
  EXPECT_EQ(first->story.states.size(), 1U);
  const auto newest = find_session(folder.str());
  ASSERT_TRUE(newest);
  EXPECT_THAT(*newest, EndsWith("journal-20260103T030405Z-001.session"));
  EXPECT_THAT(load_played(*newest)->log, EndsWith("log-20260103T030301Z.jsonl"));
}

TEST_F(OpenReplayTest, ASessionWithoutALogIsMapAndWay) {
  put_session("office.session");
  const auto played = load_played(folder.file("office.session"));
  ASSERT_TRUE(played);
  EXPECT_EQ(played->name, "office");
  EXPECT_EQ(played->log, "");
  EXPECT_EQ(played->story.states.size(), 3U);
}

TEST_F(OpenReplayTest, WhatIsNotThereIsNamed) {
  EXPECT_THAT(find_session(folder.file("nothing")).error().message, HasSubstr("nothing: there is no such"));
  EXPECT_THAT(find_session(folder.str()).error().message, HasSubstr("journal-DATE.session"));
  std::ofstream(folder.file("text.session")) << "a text";
  EXPECT_THAT(load_played(folder.file("text.session")).error().message,
              HasSubstr("does not begin as a session"));
  EXPECT_FALSE(is_recording(folder.file("text.session")));
}

}  // namespace
}  // namespace topo::daemon

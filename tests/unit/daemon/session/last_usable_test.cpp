// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/last_usable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/session/session_writer.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;

LastUsable last_in(const testing::TempDir& folder) {
  return last_usable_journal(*list_sessions(folder.str()));
}

TEST(LastUsableJournal, IsTheLastOneWithAMap) {
  const testing::TempDir folder;
  EXPECT_FALSE(last_in(folder).session);
  EXPECT_TRUE(last_in(folder).unusable.empty()) << "no journal is no fault";
  for (const char* name : {"journal-1", "journal-2", "zoo"})
    ASSERT_TRUE(save_session(folder.file(name) + ".session", testing::sample_session(5, 1), 7));
  const LastUsable last = last_in(folder);
  ASSERT_TRUE(last.session);
  EXPECT_EQ(last.session->entry.name, "journal-2") << "saved sessions are not journals";
  EXPECT_EQ(last.session->loaded.session.keyframes.size(), 5U);
  EXPECT_TRUE(last.unusable.empty());
}

TEST(LastUsableJournal, WhatCannotBeUsedIsPassedOverAndNamed) {
  const testing::TempDir folder;
  ASSERT_TRUE(save_session(folder.file("journal-1.session"), testing::sample_session(5, 1), 7));
  ASSERT_TRUE(save_session(folder.file("journal-2.session"), {}, 7));
  (void)folder.write("journal-3.session", "something else");
  (void)folder.write("journal-4.session", "");
  const LastUsable last = last_in(folder);
  ASSERT_TRUE(last.session);
  EXPECT_EQ(last.session->entry.name, "journal-1");
  ASSERT_EQ(last.unusable.size(), 3U);
  EXPECT_THAT(last.unusable[0], HasSubstr("journal-4.session: the file is empty"));
  EXPECT_THAT(last.unusable[1], HasSubstr("journal-3.session: the file does not begin as a session does"));
  EXPECT_THAT(last.unusable[2], HasSubstr("journal-2.session: no keyframe with a pose is in it"));
}

TEST(LastUsableJournal, WithoutAUsableOneThereIsNone) {
  const testing::TempDir folder;
  (void)folder.write("journal-1.session", "");
  EXPECT_FALSE(last_in(folder).session);
  EXPECT_EQ(last_in(folder).unusable.size(), 1U);
}

}  // namespace
}  // namespace topo::daemon

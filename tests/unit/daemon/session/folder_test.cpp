// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/folder.hpp"

#include <gtest/gtest.h>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

std::vector<SessionEntry> journals(const std::vector<std::string>& names) {
  std::vector<SessionEntry> entries;
  for (const std::string& name : names) entries.push_back({name, "/nowhere/" + name, 0, 0, true});
  return entries;
}

TEST(SessionFolder, Names) {
  EXPECT_TRUE(is_session_name("office-2_b"));
  EXPECT_TRUE(is_session_name("journal-1"));
  EXPECT_TRUE(is_journal_name("journal-1"));
  EXPECT_FALSE(is_journal_name("office-2_b"));
  for (const char* wrong : {"", "../x", "a b", "a.session", "journal-/../x", "a/b"})
    EXPECT_FALSE(is_session_name(wrong)) << wrong;
  EXPECT_FALSE(is_session_name(std::string(65, 'a')));
}

TEST(SessionFolder, ListsSessionsOnly) {
  const testing::TempDir folder;
  (void)folder.write("office.session", "12345");
  (void)folder.write("journal-20260101T000000Z.session", "");
  (void)folder.write("office.session.tmp", "");
  (void)folder.write("map.pgm", "");
  const auto sessions = list_sessions(folder.str());
  ASSERT_TRUE(sessions);
  ASSERT_EQ(sessions->size(), 2U);
  EXPECT_TRUE((*sessions)[0].journal);
  EXPECT_EQ((*sessions)[1].name, "office");
  EXPECT_EQ((*sessions)[1].bytes, 5U);
  EXPECT_EQ((*sessions)[1].path, session_path(folder.str(), "office"));
  EXPECT_EQ(list_sessions(folder.file("none")).error().code, types::Errc::kNotFound);
}

TEST(SessionFolder, JournalsSortByWhenTheyWereBegun) {
  constexpr std::int64_t kNoon = 1767268800;  // 2026-01-01 12:00
  EXPECT_EQ(next_journal_name(kNoon, {}), "journal-20260101T120000Z");
  std::vector<std::string> names{"journal-20260101T120000Z"};
  for (const std::int64_t second : {kNoon, kNoon - 7200, kNoon, kNoon + 1}) {
    names.push_back(next_journal_name(second, journals(names)));
    EXPECT_LT(names[names.size() - 2], names.back());
    EXPECT_EQ(newest_journal(journals(names))->name, names.back());
  }
  EXPECT_EQ(names[1], "journal-20260101T120000Z-00001");
  EXPECT_EQ(names[3], "journal-20260101T120000Z-00003");
  EXPECT_EQ(names[4], "journal-20260101T120001Z");
  EXPECT_FALSE(newest_journal({}));
}

TEST(SessionFolder, OldJournalsGoSavedSessionsStay) {
  const testing::TempDir folder;
  for (const char* name :
       {"a.session", "journal-1.session", "journal-2.session", "journal-3.session", "z.session"})
    (void)folder.write(name, "");
  EXPECT_EQ(remove_old_journals(*list_sessions(folder.str()), 2), 1U);
  const auto left = list_sessions(folder.str());
  ASSERT_EQ(left->size(), 4U);
  EXPECT_EQ((*left)[1].name, "journal-2");
}

TEST(SessionFolder, JournalsAreKeptToTheirQuota) {
  const testing::TempDir folder;
  for (const char* name : {"a.session", "journal-1.session", "journal-2.session", "journal-3.session"})
    (void)folder.write(name, std::string(100, 'x'));
  const QuotaResult kept = keep_journals_to_quota(*list_sessions(folder.str()), 250);
  EXPECT_EQ(kept.removed, 1U);
  EXPECT_EQ(kept.removed_bytes, 100U);
  EXPECT_EQ(kept.left_bytes, 200U);
  const auto left = list_sessions(folder.str());
  ASSERT_EQ(left->size(), 3U);
  EXPECT_EQ((*left)[0].name, "a");
  EXPECT_EQ((*left)[1].name, "journal-2");
}

}  // namespace
}  // namespace topo::daemon

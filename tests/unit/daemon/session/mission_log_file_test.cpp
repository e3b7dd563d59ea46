// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/mission_log_file.hpp"

#include <gtest/gtest.h>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

constexpr std::int64_t kNoon = 1'767'268'800;  // 2026-01-01T12:00:00Z

TEST(MissionLogFile, IsNamedAfterItsBeginAndHoldsItsLines) {
  const testing::TempDir folder;
  auto log = MissionLogFile::create(folder.str(), kNoon);
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->path(), folder.file("log-20260101T120000Z.jsonl"));
  EXPECT_TRUE(log->append("{}\n"));
  EXPECT_TRUE(log->append("{\"a\":1}\n{}\n"));
  EXPECT_EQ(testing::read_all(log->path()), "{}\n{\"a\":1}\n{}\n");
}

TEST(MissionLogFile, AnotherOfTheSameSecondGetsANumber) {
  const testing::TempDir folder;
  const auto first = MissionLogFile::create(folder.str(), kNoon);
  const auto second = MissionLogFile::create(folder.str(), kNoon);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(second->path(), folder.file("log-20260101T120000Z-001.jsonl"));
}

TEST(MissionLogFile, AMissingFolderIsAnError) {
  const testing::TempDir folder;
  const auto log = MissionLogFile::create(folder.file("nowhere"), kNoon);
  ASSERT_FALSE(log);
  EXPECT_NE(log.error().message.find("cannot create the mission log"), std::string::npos)
      << log.error().message;
}

TEST(MissionLogFile, TheFoldersLogsOldestFirst) {
  const testing::TempDir folder;
  (void)folder.write("log-20260102T000000Z.jsonl", "{}\n");
  (void)folder.write("log-20260101T000000Z.jsonl", "{}{}\n");
  (void)folder.write("journal-20260101T000000Z.session", "x");
  (void)folder.write("log-of-mine.txt", "x");
  const auto logs = mission_logs(folder.str());
  ASSERT_EQ(logs.size(), 2U);
  EXPECT_EQ(logs[0].path, folder.file("log-20260101T000000Z.jsonl"));
  EXPECT_EQ(logs[0].bytes, 5U);
}

}  // namespace
}  // namespace topo::daemon

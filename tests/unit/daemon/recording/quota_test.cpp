// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/recording/quota.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "daemon/recording/recorder.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> names_in(const testing::TempDir& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.str()))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Quota, OnlyRecordingsOfTheSameSeriesCount) {
  const testing::TempDir folder;
  for (const char* name :
       {"p3dx-20260101T000000Z.rec", "p3dx-20251231T000000Z.rec", "p3at-20250101T000000Z.rec",
        "p3dx-2-20250101T000000Z.rec", "p3dx-good.rec", "p3dx-20250101T000000Z.rec.txt"})
    (void)folder.write(name, "12345");
  std::vector<std::string> found;
  for (const QuotaFile& file : recordings_beside(folder.file("p3dx-20260102T000000Z.rec"))) {
    EXPECT_EQ(file.bytes, 5U);
    found.push_back(std::filesystem::path(file.path).filename());
  }
  EXPECT_THAT(found, ElementsAre("p3dx-20251231T000000Z.rec", "p3dx-20260101T000000Z.rec"));
  EXPECT_TRUE(recordings_beside(folder.file("p3dx-good.rec")).empty()) << "a name that a user gave";
}

TEST(Quota, TheOldestGoFirstAndTheLastOneNever) {
  const testing::TempDir folder;
  std::vector<QuotaFile> files;
  for (const char* name : {"1", "2", "3"}) files.push_back({folder.write(name, "1234567890"), 10});
  EXPECT_EQ(keep_to_quota(files, 30).removed, 0U);
  EXPECT_EQ(keep_to_quota(files, 29).removed, 1U);
  EXPECT_THAT(names_in(folder), ElementsAre("2", "3"));
  files.erase(files.begin());
  const QuotaResult kept = keep_to_quota(files, 1);
  EXPECT_EQ(kept.removed_bytes, 10U);
  EXPECT_EQ(kept.left_bytes, 10U);
  EXPECT_THAT(names_in(folder), ElementsAre("3"));
}

TEST(Quota, ARecordingRemovesFinishedOnesAndNeverARunningOne) {
  const testing::TempDir folder;
  const auto options_for = [&](const char* name, std::uint64_t quota, std::vector<std::string>& told) {
    RecorderOptions options;
    options.path = folder.file(name);
    options.channels = {"base"};
    options.quota_bytes = quota;
    options.on_warning = [&told](const std::string& text) { told.push_back(text); };
    return options;
  };
  (void)folder.write("r-20260101T000000Z.rec", std::string(3'000'000, 'x'));
  std::vector<std::string> told_other, told;
  const auto other = Recorder::start(options_for("r-20260102T000000Z.rec", 0, told_other));
  ASSERT_TRUE(other) << other.error().message;
  const auto recorder = Recorder::start(options_for("r-20260103T000000Z.rec", 50, told));
  ASSERT_TRUE(recorder) << recorder.error().message;
  ASSERT_TRUE((*recorder)->stop());
  EXPECT_THAT(names_in(folder), ElementsAre("r-20260102T000000Z.rec", "r-20260103T000000Z.rec"));
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0], "1 old recordings of 3 MB are removed: record.quota_mb is 0");
  EXPECT_THAT(told[1], HasSubstr("no finished recording is left to be removed"));
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/map_history.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "daemon/session/journal_file.hpp"
#include "daemon/session/session_reader.hpp"
#include "daemon/session/session_writer.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using Poses = std::vector<types::Se2>;

/// A journal whose first pose is another one with each batch.
struct Journalled {
  testing::TempDir folder;
  std::string path = folder.file("journal-1.session");
  slam::Session session;
  std::vector<Poses> batches;

  explicit Journalled(const std::vector<std::size_t>& sizes, bool close = true) {
    std::mt19937 random(1);
    auto journal = JournalFile::create(path, 7);
    for (const std::size_t size : sizes) {
      testing::drive_on(session, size, random);
      session.poses[0].x_m += 1.0;
      EXPECT_EQ(*journal->append(session), true);
      batches.push_back(session.poses);
    }
    EXPECT_TRUE(!close || journal->close(session));
  }
};

RC_GTEST_PROP(MapHistory, IsTheMapOfEachBatchThatWasWritten, ()) {
  const auto sizes =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(1, 6)));
  const Journalled journalled(sizes);
  const auto history = load_history(journalled.path);
  RC_ASSERT(history.has_value());
  RC_ASSERT(history->keyframes().size() == journalled.session.keyframes.size());
  for (const Poses& batch : journalled.batches) RC_ASSERT(history->poses(batch.size()) == batch);
}

TEST(MapHistory, AKeyframeBetweenTwoBatchesHasTheFirstPoseThatWasWrittenOfIt) {
  const Journalled journalled({3, 3});
  const auto history = load_history(journalled.path);
  ASSERT_TRUE(history);
  const Poses poses = history->poses(4);
  EXPECT_EQ(poses[0], journalled.batches[0][0]);
  EXPECT_EQ(poses[3], journalled.batches[1][3]);
  EXPECT_EQ(history->poses(100).size(), 6U) << "no more than there are";
  EXPECT_TRUE(history->poses(0).empty());
}

TEST(MapHistory, OfASavedSessionThePosesAtItsEndAreKnown) {
  const slam::Session session = testing::sample_session(5, 3);
  const auto bytes = session_bytes(session, 1);
  ASSERT_TRUE(bytes);
  const auto history = parse_history(*bytes);
  ASSERT_TRUE(history) << history.error().message;
  EXPECT_EQ(history->poses(5), session.poses);
  EXPECT_EQ(history->poses(2), Poses(session.poses.begin(), session.poses.begin() + 2));
}

TEST(MapHistory, WhatIsLeftOfAJournalIsAMapAtAnyLength) {
  const Journalled journalled({4, 4, 4}, false);
  auto bytes = *read_session_file(journalled.path);
  for (std::size_t cut = bytes.size(); cut > 30; cut -= std::min<std::size_t>(cut - 30, 97)) {
    const auto history = parse_history(std::as_bytes(std::span(bytes).first(cut)));
    if (!history) continue;
    for (std::size_t count = 0; count <= history->keyframes().size(); ++count)
      EXPECT_EQ(history->poses(count).size(), count);
  }
}

TEST(MapHistory, AFileThatIsNoneIsNamed) {
  const auto history = load_history("/dev/null/x");
  ASSERT_FALSE(history);
  EXPECT_NE(history.error().message.find("/dev/null/x"), std::string::npos);
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/session/journal_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "daemon/recording/quota.hpp"
#include "daemon/session/session_reader.hpp"
#include "tests/unit/daemon/session/session_sample.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace {

bool disk_is_broken = false;

}  // namespace

/// In place of the C library's, for this program: a disk that takes bytes and cannot keep them.
extern "C" int fdatasync(int fd) {
  if (!disk_is_broken) return static_cast<int>(::syscall(SYS_fdatasync, fd));
  errno = EIO;
  return -1;
}

namespace topo::daemon {
namespace {

/// Files of this process can grow to so many bytes and no further: a full disk without one.
class SmallDisk {
 public:
  explicit SmallDisk(std::uint64_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit small = before_;
    small.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
};

TEST(JournalFile, HoldsWhatWasAppendedWithoutBeingClosed) {
  const testing::TempDir folder;
  std::mt19937 random(1);
  slam::Session session;
  auto journal = JournalFile::create(folder.file("journal-1.session"), 7);
  ASSERT_TRUE(journal) << journal.error().message;
  EXPECT_FALSE(JournalFile::create(folder.file("journal-1.session"), 7)) << "never another one's";
  for (int i = 0; i < 5; ++i) {
    testing::grow(session, 4, random);
    EXPECT_EQ(*journal->append(session), true);
    EXPECT_EQ(*journal->append(session), false);
    const auto loaded = load_session(journal->path());
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(testing::same(loaded->session, session));
    EXPECT_FALSE(loaded->closed);
  }
  ASSERT_TRUE(journal->close(session));
  EXPECT_TRUE(load_session(journal->path())->closed);
}

TEST(JournalFile, ClosingWritesTheExactPoses) {
  const testing::TempDir folder;
  slam::Session session = testing::sample_session(10, 2);
  auto journal = JournalFile::create(folder.file("j.session"), 7);
  ASSERT_TRUE(journal);
  ASSERT_TRUE(journal->append(session));
  session.poses[4].y_m += 0.003;
  EXPECT_EQ(*journal->append(session), false);
  ASSERT_TRUE(journal->close(session));
  EXPECT_TRUE(testing::same(load_session(journal->path())->session, session));
}

// Of two daemons with one folder neither removes what the other one writes.
TEST(JournalFile, IsNotRemovedWhileItIsWritten) {
  const testing::TempDir folder;
  {
    auto journal = JournalFile::create(folder.file("journal-1.session"), 7);
    ASSERT_TRUE(journal) << journal.error().message;
    EXPECT_FALSE(remove_finished(journal->path()));
    EXPECT_TRUE(std::filesystem::exists(journal->path()));
  }
  EXPECT_TRUE(remove_finished(folder.file("journal-1.session")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("journal-1.session")));
}

// What a full disk did not take is lost only if it stays full: the file stays readable all the while.
TEST(JournalFile, AFullDiskKeepsWhatIsThereAndIsCaughtUpWith) {
  const testing::TempDir folder;
  std::mt19937 random(3);
  slam::Session session;
  testing::grow(session, 10, random);
  auto journal = JournalFile::create(folder.file("j.session"), 7);
  ASSERT_TRUE(journal);
  ASSERT_TRUE(journal->append(session));
  const slam::Session before = session;
  testing::grow(session, 30, random);
  {
    const SmallDisk disk(journal->bytes() + 700);
    for (int i = 0; i < 3; ++i) {
      const auto failed = journal->append(session);
      ASSERT_FALSE(failed);
      EXPECT_EQ(failed.error().sys_errno, EFBIG);
      EXPECT_EQ(std::filesystem::file_size(journal->path()), journal->bytes());
      EXPECT_TRUE(testing::same(load_session(journal->path())->session, before));
    }
  }
  testing::grow(session, 5, random);
  ASSERT_TRUE(journal->append(session));
  EXPECT_TRUE(testing::same(load_session(journal->path())->session, session));
}

// What comes next may be shorter, and would have the rest of it behind itself.
TEST(JournalFile, WhatCannotBeBroughtToTheDiskIsTakenBack) {
  const testing::TempDir folder;
  std::mt19937 random(4);
  slam::Session session;
  testing::grow(session, 10, random);
  auto journal = JournalFile::create(folder.file("j.session"), 7);
  ASSERT_TRUE(journal);
  ASSERT_TRUE(journal->append(session));
  const slam::Session before = session;
  testing::grow(session, 5, random);
  disk_is_broken = true;
  const auto failed = journal->append(session);
  disk_is_broken = false;
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().sys_errno, EIO);
  EXPECT_EQ(std::filesystem::file_size(journal->path()), journal->bytes());
  EXPECT_TRUE(testing::same(load_session(journal->path())->session, before));
  ASSERT_TRUE(journal->append(session));
  EXPECT_TRUE(testing::same(load_session(journal->path())->session, session));
}

}  // namespace
}  // namespace topo::daemon

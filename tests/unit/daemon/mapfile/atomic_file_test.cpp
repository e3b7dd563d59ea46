// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/atomic_file.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>

#include <filesystem>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;
using testing::read_all;

std::size_t files_in(const std::string& folder) {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++n;
  return n;
}

TEST(AtomicFile, ReplacesTheOldContent) {
  const testing::TempDir dir;
  const std::string path = dir.write("a.txt", "old and longer");
  ASSERT_TRUE(write_file(path, "new").has_value());
  EXPECT_EQ(read_all(path), "new");
  EXPECT_EQ(files_in(dir.str()), 1U);
}

TEST(AtomicFile, OfSeveralFilesAllOrNone) {
  const testing::TempDir dir;
  const std::string a = dir.write("a.txt", "old");
  const std::string text = "new";
  const auto bytes = std::as_bytes(std::span(text));
  const FileContent files[] = {{a, bytes}, {dir.file("none/b.txt"), bytes}};
  const auto s = write_files(files);
  ASSERT_FALSE(s.has_value());
  EXPECT_THAT(s.error().message, HasSubstr("none/b.txt"));
  EXPECT_EQ(read_all(a), "old");
  EXPECT_EQ(files_in(dir.str()), 1U);
}

TEST(AtomicFile, AFullDiskLeavesTheOldFileAndNoOther) {
  const testing::TempDir dir;
  const std::string path = dir.write("a.txt", "old");
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ::getrlimit(RLIMIT_FSIZE, &old);
  rlimit small = old;
  small.rlim_cur = 1000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  const auto s = write_file(path, std::string(5000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &old);
  ASSERT_FALSE(s.has_value());
  EXPECT_THAT(s.error().message, HasSubstr("a.txt: cannot write"));
  EXPECT_EQ(read_all(path), "old");
  EXPECT_EQ(files_in(dir.str()), 1U);
}

TEST(AtomicFile, AFolderInTheWayIsNamed) {
  const testing::TempDir dir;
  std::filesystem::create_directory(dir.file("map.pgm"));
  const auto s = write_file(dir.file("map.pgm"), "x");
  ASSERT_FALSE(s.has_value());
  EXPECT_THAT(s.error().message, HasSubstr("map.pgm"));
  EXPECT_EQ(files_in(dir.str()), 1U);
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/input_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;
using types::Errc;

TEST(InputFile, IsReadAsAWholeOrItsBeginning) {
  const testing::TempDir folder;
  const std::string path = folder.write("a", "12345");
  EXPECT_EQ(read_file(path, 5).value_or(""), "12345");
  EXPECT_THAT(read_file(path, 4).error().message, HasSubstr("found 5 bytes, expected at most 4"));
  EXPECT_EQ(read_beginning(path, 3).value_or(""), "123");
  EXPECT_EQ(read_beginning(path, 9).value_or(""), "12345");
  EXPECT_EQ(read_beginning(folder.file("none"), 3).error().code, Errc::kNotFound);
}

// Who opened it to read would wait for a writer, for ever.
TEST(InputFile, AFifoIsRefusedAtOnce) {
  const testing::TempDir folder;
  const std::string path = folder.file("fifo");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_THAT(read_file(path, 5).error().message, HasSubstr("found a special file, expected a file"));
  EXPECT_EQ(read_beginning(path, 5).error().code, Errc::kInvalidInput);
}

TEST(InputFile, AFolderIsNone) {
  const testing::TempDir folder;
  EXPECT_THAT(read_file(folder.str(), 5).error().message, HasSubstr("found a directory"));
}

}  // namespace
}  // namespace topo::daemon

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/estop/latch_file.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class LatchFileTest : public ::testing::Test {
 protected:
  testing::TempDir folder;
  std::string path = latch_path(folder.str());
};

TEST_F(LatchFileTest, NoFileIsNotLatched) {
  EXPECT_FALSE(read_latch(path).latched);
  EXPECT_FALSE(read_latch(latch_path(folder.file("no/such"))).latched);
}

TEST_F(LatchFileTest, KeptIsReadBackAndRemoved) {
  ASSERT_TRUE(keep_latch(path, "an operator's e-stop"));
  const FoundLatch found = read_latch(path);
  EXPECT_TRUE(found.latched);
  EXPECT_FALSE(found.damaged);
  EXPECT_THAT(found.text, HasSubstr("Z an operator's e-stop"));
  ASSERT_TRUE(remove_latch(path));
  EXPECT_FALSE(read_latch(path).latched);
  EXPECT_TRUE(std::filesystem::is_empty(folder.str()));
}

TEST_F(LatchFileTest, DamagedIsLatchedAndSaysSo) {
  ASSERT_TRUE(keep_latch(path, "why"));
  const std::string whole = testing::read_all(path);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    (void)folder.write("estop.latch", whole.substr(0, size));
    const FoundLatch found = read_latch(path);
    EXPECT_TRUE(found.latched && found.damaged) << size;
    EXPECT_THAT(found.text, StartsWith(path + ": damaged")) << size;
  }
  (void)folder.write("estop.latch", std::string(5000, 'x'));
  EXPECT_TRUE(read_latch(path).latched && read_latch(path).damaged);
}

TEST_F(LatchFileTest, UnreadableIsLatched) {
  std::filesystem::create_directory(path);
  EXPECT_TRUE(read_latch(path).latched && read_latch(path).damaged);
  EXPECT_THAT(read_latch(path).text, HasSubstr("cannot be read"));
  std::filesystem::remove(path);
  std::filesystem::create_symlink(folder.file("nothing"), path);
  EXPECT_TRUE(read_latch(path).latched && read_latch(path).damaged);
}

TEST_F(LatchFileTest, FailuresNameTheFile) {
  const std::string nowhere = latch_path(folder.file("no"));
  EXPECT_THAT(keep_latch(nowhere, "why").error().message, HasSubstr(nowhere));
  EXPECT_TRUE(remove_latch(nowhere)) << "there is nothing to be removed";
  std::filesystem::create_directory(path);
  EXPECT_THAT(remove_latch(path).error().message, HasSubstr(path));
}

}  // namespace
}  // namespace topo::daemon

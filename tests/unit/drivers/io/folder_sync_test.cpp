// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/io/folder_sync.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace topo::io {
namespace {

TEST(FolderSync, TheFoldersOfAFileAreBroughtToTheDisk) {
  const auto folder = std::filesystem::temp_directory_path();
  EXPECT_TRUE(sync_folder_of((folder / "any").string())) << "the file itself need not be there";
  EXPECT_TRUE(sync_folder_of("any")) << "in the working folder";
}

TEST(FolderSync, AFolderThatIsNotThereIsNamed) {
  const auto failed = sync_folder_of("/nowhere/at/all/file");
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().sys_errno, ENOENT);
  EXPECT_TRUE(failed.error().message.starts_with("/nowhere/at/all: cannot bring the folder to the disk"))
      << failed.error().message;
}

}  // namespace
}  // namespace topo::io

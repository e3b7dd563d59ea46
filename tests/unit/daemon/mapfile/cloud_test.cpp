// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/cloud.hpp"

#include <gmock/gmock.h>

#include <string>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::UnorderedElementsAre;

TEST(Cloud, HasOnePointForEachSlabInTheMiddleOfItsCell) {
  patricia::Arena<walls::Slabs> arena;
  walls::WallStore store(arena, 0.5);
  store.add(store.cell_at({0.1, -0.1}), 1U << 31U | 1U);
  store.add(store.cell_at({-3.2, 4.0}), 4U);
  EXPECT_THAT(cloud_of(store),
              UnorderedElementsAre(CloudPoint{0.25F, -0.25F, 0.05F}, CloudPoint{0.25F, -0.25F, 3.15F},
                                   CloudPoint{-3.25F, 4.25F, 0.25F}));
}

TEST(Cloud, PlyHasTheseBytes) {
  const testing::TempDir dir;
  const CloudPoint points[] = {{1.0F, -2.0F, 0.5F}};
  ASSERT_TRUE(save_cloud(dir.file("cloud.ply"), points).has_value());
  EXPECT_EQ(testing::read_all(dir.file("cloud.ply")),
            "ply\nformat binary_little_endian 1.0\ncomment topometric, metres, frame map\nelement vertex 1\n"
            "property float x\nproperty float y\nproperty float z\nend_header\n" +
                std::string("\0\0\x80\x3F\0\0\0\xC0\0\0\0\x3F", 12));
}

TEST(Cloud, AnEmptyStoreIsAFileWithoutPoints) {
  const testing::TempDir dir;
  ASSERT_TRUE(save_cloud(dir.file("cloud.ply"), {}).has_value());
  const std::string text = testing::read_all(dir.file("cloud.ply"));
  EXPECT_NE(text.find("element vertex 0\n"), std::string::npos);
  EXPECT_TRUE(text.ends_with("end_header\n"));
}

}  // namespace
}  // namespace topo::daemon

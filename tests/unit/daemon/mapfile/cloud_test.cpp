// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/mapfile/cloud.hpp"

#include <gmock/gmock.h>

#include <cstring>

#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

using ::testing::UnorderedElementsAre;

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

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
  const CloudPoint points[] = {{1.0F, -2.0F, 0.5F}};
  EXPECT_EQ(text_of(encode_ply(points)),
            "ply\nformat binary_little_endian 1.0\ncomment topometric, metres, frame map\nelement vertex 1\n"
            "property float x\nproperty float y\nproperty float z\nend_header\n" +
                std::string("\0\0\x80\x3F\0\0\0\xC0\0\0\0\x3F", 12));
  const float intensity[] = {0.25F};
  const std::string with = text_of(encode_ply(points, intensity));
  EXPECT_NE(with.find("property float intensity\nend_header\n"), std::string::npos);
  EXPECT_EQ(with.substr(with.size() - 4), std::string("\0\0\x80\x3E", 4));
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

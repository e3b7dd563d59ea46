// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Damaged maps are refused or read, never a crash, a hang or a read outside (run under ASan and UBSan).
#include <gtest/gtest.h>

#include <random>

#include "daemon/mapfile/grey_image.hpp"
#include "daemon/mapfile/map_image.hpp"
#include "daemon/mapfile/picture.hpp"
#include "tests/unit/daemon/support/mutate.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

template <class Decode>
void survive(const std::string& good, Decode decode) {
  std::mt19937 random(3);  // NOLINT: the same damage every time
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    const auto got = decode("mutant", testing::mutate(good, 10, random));
    if (got.has_value()) {
      ASSERT_EQ(got->pixels.size(),
                static_cast<std::size_t>(got->width) * static_cast<std::size_t>(got->height));
      continue;
    }
    ++refused;
    EXPECT_TRUE(got.error().message.starts_with("mutant: ")) << got.error().message;
  }
  EXPECT_GT(refused, 20);
}

TEST(MapMutation, PgmDecoderSurvives) {
  survive("P5\n# c\n4 3\n255\n123456789012", decode_pgm);
  survive("P2 4 3 255 1 2 3 4 5 6 7 8 9 10 11 12", decode_pgm);
}

TEST(MapMutation, PngDecoderSurvives) {
  const testing::TempDir dir;
  Picture picture(20, 10, {1, 2, 3});
  picture.disc(5, 5, 4, {200, 100, 0});
  ASSERT_TRUE(save_png(dir.file("m.png"), picture).has_value());
  survive(testing::read_all(dir.file("m.png")), decode_png);
}

TEST(MapMutation, YamlReaderSurvives) {
  const testing::TempDir dir;
  static_cast<void>(dir.write("m.pgm", "P2 1 1 255 0"));
  const std::string good =
      "image: m.pgm\nmode: trinary\nresolution: 0.05\norigin: [1, 2, 3]\nnegate: 0\noccupied_thresh: "
      "0.65\nfree_thresh: 0.196\n";
  std::mt19937 random(5);  // NOLINT
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    const auto map = load_map(dir.write("m.yaml", testing::mutate(good, 10, random)));
    refused += map.has_value() ? 0 : 1;
    if (map.has_value()) {
      EXPECT_EQ(map->cells.size(), 1U);
    }
  }
  EXPECT_GT(refused, 100);
  const auto deep = load_map(dir.write("m.yaml", "image: " + std::string(60000, '[')));
  EXPECT_FALSE(deep.has_value());
}

}  // namespace
}  // namespace topo::daemon

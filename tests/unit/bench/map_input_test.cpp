// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/analyse/map_input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/bench/topobench/analyse/analyse_command.hpp"
#include "tests/bench/topobench/analyse/timed_analysis.hpp"

namespace topo::bench {
namespace {

/// A PGM file while it is needed.
class PictureFile {
 public:
  PictureFile(int width, int height, const std::string& pixels)
      : path_((std::filesystem::path(testing::TempDir()) /
               (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".pgm"))
                  .string()) {
    std::ofstream(path_, std::ios::binary) << "P5\n" << width << ' ' << height << "\n255\n" << pixels;
  }
  ~PictureFile() { std::filesystem::remove(path_); }
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(MapInput, OfATurnedMapIsRefused) {
  const PictureFile picture(2, 1, {'\xFF', '\xFF'});
  const std::string yaml = picture.path() + ".yaml";
  const auto read_with_yaw = [&](const std::string& yaw) {
    std::ofstream(yaml) << "image: " << picture.path() << "\nresolution: 0.1\norigin: [1, -2, " << yaw
                        << "]\n";
    return read_map_input(yaml, 0.0);
  };
  for (const char* none : {"0.0", "-0.0", "6.283185307"}) {
    const auto input = read_with_yaw(none);
    ASSERT_TRUE(input) << none;
    EXPECT_EQ(input->origin, types::Vector2(1.0, -2.0));
  }
  const auto turned = read_with_yaw("1.57");
  std::filesystem::remove(yaml);
  ASSERT_FALSE(turned);
  EXPECT_NE(turned.error().message.find("key origin: found a yaw of 1.57, expected 0"), std::string::npos);
}

TEST(MapInput, OfAPictureIsFreeFrom250AndOccupiedBelow89) {
  const PictureFile file(5, 1, {'\xFF', '\xFA', '\xF9', '\x59', '\x58'});
  const auto input = read_map_input(file.path(), 0.1);
  ASSERT_TRUE(input.has_value()) << input.error().message;
  using grid::CellState;
  EXPECT_EQ(input->map.state({0, 0}), CellState::kFree);
  EXPECT_EQ(input->map.state({1, 0}), CellState::kFree);
  EXPECT_EQ(input->map.state({2, 0}), CellState::kUnknown);
  EXPECT_EQ(input->map.state({3, 0}), CellState::kUnknown);
  EXPECT_EQ(input->map.state({4, 0}), CellState::kOccupied);
  EXPECT_EQ(input->map.width(), 7);
  EXPECT_DOUBLE_EQ(input->map.resolution_m, 0.1);
}

TEST(MapInput, RefusesWhatIsNoMap) {
  EXPECT_FALSE(read_map_input("/nowhere/map.png", 0.05).has_value());
  EXPECT_FALSE(read_map_input("/nowhere/map.yaml", 0.05).has_value());
  {
    const PictureFile empty(0, 0, "");
    EXPECT_FALSE(read_map_input(empty.path(), 0.05).has_value());
  }
  const PictureFile file(2, 1, "ab");
  EXPECT_TRUE(read_map_input(file.path(), 0.05).has_value());
  for (const double resolution_m : {0.0, -1.0, 100.0, std::nan("")})
    EXPECT_FALSE(read_map_input(file.path(), resolution_m).has_value()) << resolution_m;
}

/// Nothing, one cell, all free, all occupied, all unknown, a passage one pixel wide, noise.
TEST(Analysis, AnswersWhateverTheMapIs) {
  std::string noise;
  std::uint32_t random = 1;
  for (int i = 0; i < 80 * 60; ++i) {
    random = random * 1664525U + 1013904223U;
    noise.push_back(static_cast<char>(random >> 24U));
  }
  std::string passage(static_cast<std::size_t>(80 * 60), '\0');
  std::fill_n(passage.begin() + 80 * 30, 80, '\xFF');
  const auto all = [](char grey) { return std::string(static_cast<std::size_t>(80 * 60), grey); };
  for (const std::string& pixels : {all('\xFF'), all('\0'), all('\x80'), passage, noise}) {
    const PictureFile file(80, 60, pixels);
    const auto input = read_map_input(file.path(), 0.50);  // at 0.35 m the passage is too narrow for a place
    ASSERT_TRUE(input.has_value()) << input.error().message;
    const TimedAnalysis timed = timed_analysis(input->map, 2);
    for (const auto& ms : timed.ms) EXPECT_EQ(ms.size(), 2U);
    const LabelPicture labels = labels_of(*input, timed.analysis);
    ASSERT_EQ(labels.values.size(), pixels.size());
    const bool any_free = pixels[80 * 30] == '\xFF';
    if (pixels != noise) {
      EXPECT_EQ(labels.values[80 * 30 + 40], any_free ? 1U : 0U);
      EXPECT_EQ(timed.analysis.places.places.size(), any_free ? 1U : 0U);
    }
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const bool free = static_cast<unsigned char>(pixels[i]) >= 250;
      EXPECT_TRUE(free || labels.values[i] == 0U);
    }
  }
  const PictureFile one(1, 1, "\xFF");
  EXPECT_EQ(timed_analysis(read_map_input(one.path(), 0.05)->map, 1).analysis.places.places.size(), 0U);
}

}  // namespace
}  // namespace topo::bench

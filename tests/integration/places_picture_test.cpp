// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's figure 7 by the whole analysis: one drawn building clean (a) and cluttered (b), the skeleton
// (c) and the places (d) of the cluttered one. With TOPOMETRIC_OUT in the environment the four become
// places.png there, the picture of the README.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "core/analysis/analysis.hpp"
#include "core/grid/distance.hpp"
#include "daemon/mapfile/overview.hpp"
#include "daemon/mapfile/picture.hpp"
#include "tests/unit/core/places/building.hpp"

namespace topo {
namespace {

using daemon::Picture;
using daemon::Rgb;

analysis::Analysis analysis_of(const grid::DenseMap& map) {
  const std::vector<float> clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  return analysis::analyse({1, map, clearance_m, {}, {}}, {});
}

/// Of the whole analysis what a picture shall show.
analysis::Analysis part_of(const analysis::Analysis& whole, bool skeleton, bool places) {
  analysis::Analysis part;
  part.map = whole.map;
  if (skeleton) part.skeleton = whole.skeleton;
  if (places) {
    part.places = whole.places;
    part.walls = whole.walls;
  }
  return part;
}

Picture picture_of(const analysis::Analysis& analysis) { return daemon::overview_of(analysis, {}, {}); }

/// Two by two, with a white margin between them.
Picture tiled(const std::array<Picture, 4>& pictures) {
  constexpr int kMargin = 12;
  int width = 0, height = 0;  // the cluttered building has alcoves beyond its walls
  for (const Picture& picture : pictures) {
    width = std::max(width, picture.width());
    height = std::max(height, picture.height());
  }
  Picture all(2 * width + kMargin, 2 * height + kMargin, Rgb{255, 255, 255});
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const int left = k % 2 == 0 ? 0 : width + kMargin, top = k < 2 ? 0 : height + kMargin;
    for (int y = 0; y < pictures[k].height(); ++y) {
      for (int x = 0; x < pictures[k].width(); ++x) all.set(left + x, top + y, pictures[k].at(x, y));
    }
  }
  return all;
}

double worst_overlap(const analysis::Analysis& a, const analysis::Analysis& b) {
  double worst = 1.0;
  const auto labels = a.places.labels.by_cell(a.map.cells.size()),
             others = b.places.labels.by_cell(b.map.cells.size());
  for (const auto& [share, cells] : places::best_overlaps(labels, others)) worst = std::min(worst, share);
  return worst;
}

TEST(PlacesPicture, ShowsTheSamePlacesCleanAndCluttered) {
  const analysis::Analysis clean = analysis_of(places::clean_building().map());
  const analysis::Analysis cluttered = analysis_of(places::cluttered_building().map());
  EXPECT_EQ(cluttered.places.places.size(), clean.places.places.size());
  EXPECT_GE(worst_overlap(clean, cluttered), 0.9);
  EXPECT_GE(worst_overlap(cluttered, clean), 0.9);
  ASSERT_TRUE(clean.compass.angle_rad.has_value());
  EXPECT_NEAR(*clean.compass.angle_rad, *cluttered.compass.angle_rad, 0.2 * types::kDegree_rad);

  const std::array<Picture, 4> pictures{
      picture_of(part_of(clean, false, false)), picture_of(part_of(cluttered, false, false)),
      picture_of(part_of(cluttered, true, false)), picture_of(part_of(cluttered, false, true))};
  for (std::size_t k = 1; k < pictures.size(); ++k) {
    EXPECT_FALSE(std::equal(pictures[k].pixels().begin(), pictures[k].pixels().end(),
                            pictures[k - 1].pixels().begin(), pictures[k - 1].pixels().end()));
  }
  if (const char* folder = std::getenv("TOPOMETRIC_OUT")) {
    std::filesystem::create_directories(folder);
    const auto saved =
        daemon::save_png((std::filesystem::path(folder) / "places.png").string(), tiled(pictures));
    EXPECT_TRUE(saved.has_value());
  }
}

}  // namespace
}  // namespace topo

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <filesystem>

#include "core/grid/occupancy_grid.hpp"
#include "daemon/mapfile/map_image.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::daemon {
namespace {

MapImage small_map() {
  MapImage map{3, 2, 0.05, {-1.25, 0.5, 0.0}, {}};
  map.cells = {MapCell::kFree,    MapCell::kOccupied, MapCell::kUnknown,
               MapCell::kUnknown, MapCell::kUnknown,  MapCell::kFree};
  return map;
}

TEST(MapFile, ThePairHasTheseBytes) {
  const testing::TempDir dir;
  ASSERT_TRUE(save_map(dir.str(), small_map()).has_value());
  EXPECT_EQ(
      testing::read_all(dir.file("map.pgm")),
      "P5\n# CREATOR: topometric 0.050 m/pix\n3 2\n255\n\xCD\xCD\xFE\xFE" + std::string(1, '\0') + "\xCD");
  EXPECT_EQ(testing::read_all(dir.file("map.yaml")),
            "image: map.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.25, 0.5, 0.0]\nnegate: "
            "0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST(MapFile, AMissingFolderIsNamedAndNothingWritten) {
  const testing::TempDir dir;
  const auto s = save_map(dir.file("none"), small_map());
  ASSERT_FALSE(s.has_value());
  EXPECT_THAT(s.error().message, ::testing::HasSubstr("none/map.pgm"));
  EXPECT_FALSE(std::filesystem::exists(dir.file("none")));
}

TEST(MapFile, WhatIsSavedComesBack) {
  const testing::TempDir dir;
  EXPECT_TRUE(rc::check([&dir] {
    MapImage map;
    map.width = *rc::gen::inRange(1, 30);
    map.height = *rc::gen::inRange(1, 30);
    map.resolution_m = *rc::gen::inRange(1, 1000) / 1000.0;
    map.origin = {*rc::gen::inRange(-100000, 100000) / 1000.0, *rc::gen::inRange(-100000, 100000) / 1000.0,
                  *rc::gen::inRange(-3000, 3000) / 1000.0};
    map.cells = *rc::gen::container<std::vector<MapCell>>(
        static_cast<std::size_t>(map.width * map.height),
        rc::gen::element(MapCell::kFree, MapCell::kOccupied, MapCell::kUnknown));
    RC_ASSERT(save_map(dir.str(), map).has_value());
    const auto back = load_map(dir.file("map.yaml"));
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->width == map.width);
    RC_ASSERT(back->height == map.height);
    RC_ASSERT(back->resolution_m == map.resolution_m);
    RC_ASSERT(std::abs(back->origin.x_m - map.origin.x_m) < 1e-9);
    RC_ASSERT(std::abs(back->origin.y_m - map.origin.y_m) < 1e-9);
    RC_ASSERT(std::abs(back->origin.theta_rad - map.origin.theta_rad) < 1e-9);
    RC_ASSERT(back->cells == map.cells);
  }));
}

TEST(MapFile, AGridBecomesAnImageWithItsMargin) {
  patricia::Arena<grid::TileRef> arena;
  grid::OccupancyGrid grid(arena, 0.5);
  grid.tile_to_change(0, 0).cells[grid::Tile::index(2, 1)] = {5, 0};      // cell (2, 1) occupied
  grid.tile_to_change(-1, -1).cells[grid::Tile::index(31, 30)] = {0, 5};  // cell (-1, -2) free
  const auto image = image_of(grid, 1);
  ASSERT_TRUE(image.has_value()) << image.error().message;
  EXPECT_EQ(image->width, 4 + 2);
  EXPECT_EQ(image->height, 4 + 2);
  EXPECT_EQ(image->origin, (types::Se2{-1.0, -1.5, 0.0}));
  EXPECT_EQ(image->at(4, 4), MapCell::kOccupied);
  EXPECT_EQ(image->at(1, 1), MapCell::kFree);
  EXPECT_EQ(std::count(image->cells.begin(), image->cells.end(), MapCell::kUnknown), 34);
}

TEST(MapFile, AnEmptyGridIsASmallUnknownImageAndAHugeOneIsRefused) {
  patricia::Arena<grid::TileRef> arena;
  grid::OccupancyGrid grid(arena, 0.05);
  const auto empty = image_of(grid, 0);
  ASSERT_TRUE(empty.has_value());
  EXPECT_THAT(empty->cells, ::testing::ElementsAre(MapCell::kUnknown));
  grid.tile_to_change(-20000, 0).cells[0] = {1, 0};
  grid.tile_to_change(20000, 0).cells[0] = {1, 0};
  const auto huge = image_of(grid);
  ASSERT_FALSE(huge.has_value());
  EXPECT_THAT(huge.error().message, ::testing::HasSubstr("found 1280009 x 9 cells"));
}

}  // namespace
}  // namespace topo::daemon

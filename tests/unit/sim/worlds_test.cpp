// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "tests/sim/area.hpp"
#include "tests/sim/image_file.hpp"
#include "tests/sim/picture.hpp"
#include "tests/sim/robot_model.hpp"
#include "tests/sim/world.hpp"
#include "tests/unit/sim/rooms.hpp"

namespace topo::sim {
namespace {

using testing::HasSubstr;

std::filesystem::path folder() {
  const auto dir = std::filesystem::path(testing::TempDir()) / "topo_worlds";
  std::filesystem::create_directories(dir);
  return dir;
}

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string message(const types::Result<World>& world) {
  return world.has_value() ? "no error" : world.error().message;
}

// A room of 100 x 80 pixels of 0.1 m; `paint` may draw in it. Row 0 is the top.
template <class Paint>
std::filesystem::path image_world(const std::string& name, const Paint& paint) {
  constexpr int kWidth = 100;
  constexpr int kHeight = 80;
  std::string pixels(kWidth * kHeight, char(254));
  const auto set = [&](int x, int y, int value) {
    pixels[static_cast<std::size_t>(y * kWidth + x)] = static_cast<char>(value);
  };
  for (int x = 0; x < kWidth; ++x) set(x, 0, 0), set(x, kHeight - 1, 0);
  for (int y = 0; y < kHeight; ++y) set(0, y, 0), set(kWidth - 1, y, 0);
  paint(set);
  write(folder() / (name + ".pgm"), "P5\n# drawn\n100 80\n255\n" + pixels);
  const auto yaml = folder() / (name + ".yaml");
  write(yaml, "image: " + name +
                  ".pgm\nresolution: 0.1\norigin: [1.0, 2.0, 0.0]\nnegate: 0\noccupied_thresh: "
                  "0.65\nfree_thresh: 0.196\n");
  return yaml;
}

TEST(ImageWorld, StandsWhereTheOriginSaysAndTheTopRowIsTheFarthest) {
  const auto yaml = image_world("origin", [](const auto& set) {
    for (int x = 40; x < 60; ++x) set(x, 20, 0);
  });
  const auto world = World::load(yaml);
  ASSERT_TRUE(world.has_value()) << message(world);
  // Inner faces at x = 1.1 and 10.9, y = 2.1 and 9.9; the bar is row 20: y from 2 + 5.9 to 2 + 6.0.
  EXPECT_NEAR(world->level_range_m(2.0, 3.0, 0.3, 0.0), 8.9, 1e-9);
  EXPECT_NEAR(world->level_range_m(2.0, 3.0, 0.3, std::numbers::pi), 0.9, 1e-9);
  EXPECT_NEAR(world->level_range_m(2.0, 3.0, 0.3, 0.5 * std::numbers::pi), 6.9, 1e-9);
  EXPECT_NEAR(world->level_range_m(6.0, 3.0, 0.3, 0.5 * std::numbers::pi), 4.9, 1e-9);
}

TEST(ImageWorld, SmallPiecesAreFurnitureAndLargeOnesWalls) {
  const auto yaml = image_world("heights", [](const auto& set) {
    for (int i = 0; i < 9; ++i) set(20 + i, 40, 0), set(20, 40 - i, 0);  // 0.9 m across: furniture
    for (int i = 0; i < 10; ++i) set(60 + i, 40, 0);                     // 1.0 m: wall
    for (int i = 0; i < 6; ++i)
      set(80 + i, 30 + i, 0), set(80 + i, 60, 205);  // corners join; unknown is solid
  });
  const auto world = World::load(yaml);
  ASSERT_TRUE(world.has_value()) << message(world);
  EXPECT_TRUE(world->solid_at(3.45, 5.95, 0.75));
  EXPECT_FALSE(world->solid_at(3.45, 5.95, 0.85));
  EXPECT_TRUE(world->solid_at(7.45, 5.95, 2.4));
  EXPECT_TRUE(world->solid_at(9.25, 3.95, 0.5));
  EXPECT_FALSE(world->solid_at(9.25, 3.95, 1.0));
  EXPECT_EQ(world->prisms().size(), 3U);
  // Level rays under and over the furniture's 0.8 m.
  EXPECT_NEAR(world->level_range_m(3.45, 3.0, 0.3, 0.5 * std::numbers::pi), 2.9, 0.06);
  EXPECT_NEAR(world->level_range_m(3.45, 3.0, 1.0, 0.5 * std::numbers::pi), 6.9, 1e-6);
}

TEST(ImageWorld, SlantedWallsAreNoStairs) {
  // A wall of slope 1:5 drawn as pixels: how far rays of a scan are from the straight line.
  const auto yaml = image_world("slanted", [](const auto& set) {
    for (int x = 5; x < 95; ++x)
      for (int y = 0; y < 20 + x / 5; ++y) set(x, y, 0);
  });
  const auto world = World::load(yaml);
  ASSERT_TRUE(world.has_value()) << message(world);
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (double x = 3.0; x < 9.0; x += 0.01) {
    const double y = 3.0 + world->level_range_m(x, 3.0, 0.3, 0.5 * std::numbers::pi);
    const double error = y + 0.2 * x;
    sum += error, squares += error * error, ++count;
  }
  const double deviation_m = std::sqrt(squares / count - (sum / count) * (sum / count));
  EXPECT_LT(deviation_m, 0.005);  // stairs of 0.1 m would give 0.029; the sensor's noise is 0.030
}

TEST(ImageWorld, FaultsNameFilePlaceAndWhatIsExpected) {
  const auto dir = folder();
  EXPECT_THAT(message(World::load(dir / "none.yaml")), HasSubstr("none.yaml: cannot be opened"));
  EXPECT_THAT(message(World::load(dir / "world.txt")), HasSubstr("expected a map_server map"));
  write(dir / "bad.yaml", "image: nothing.pgm\nresolution: .nan\norigin: [0.0, x, 0.0]\n");
  EXPECT_THAT(message(World::load(dir / "bad.yaml")),
              HasSubstr("bad.yaml:2:13: 'resolution' is '.nan'; expected a number from 0.001 to 1"));
  EXPECT_THAT(message(World::load(dir / "bad.yaml")),
              HasSubstr("bad.yaml:3:15: 'origin' is 'x'"));  // all at once
  write(dir / "missing.yaml", "resolution: 0.05\n");
  EXPECT_THAT(message(World::load(dir / "missing.yaml")),
              HasSubstr("missing.yaml:1:1: key 'image' is missing"));
  write(dir / "turned.yaml",
        "image: nothing.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 1.57]\nresolution: 0.1\n");
  EXPECT_THAT(message(World::load(dir / "turned.yaml")),
              HasSubstr("turned.yaml:3:9: 'origin' has a yaw of 1.57; expected 0"));
  EXPECT_THAT(message(World::load(dir / "turned.yaml")),
              HasSubstr("turned.yaml:4:1: key 'resolution' stands in line 2 already; expected it once"));
  write(dir / "list.yaml", "- 1\n");
  EXPECT_THAT(message(World::load(dir / "list.yaml")), HasSubstr("expected the keys"));
  write(dir / "broken.yaml", "image: [\n");
  EXPECT_THAT(message(World::load(dir / "broken.yaml")), HasSubstr("no YAML"));
}

TEST(ImageWorld, BadImagesAreRefused) {
  const auto dir = folder();
  const auto with_image = [&](const std::string& bytes) {
    write(dir / "picture.pgm", bytes);
    write(dir / "picture.yaml", "image: picture.pgm\nresolution: 0.05\n");
    return message(World::load(dir / "picture.yaml"));
  };
  EXPECT_THAT(with_image("GIF89a"), HasSubstr("picture.pgm: neither PNG nor PGM"));
  EXPECT_THAT(with_image("P5\n10 10\n255\nshort"), HasSubstr("PGM cut off: 5 of 100 bytes"));
  EXPECT_THAT(with_image("P5\n100000 100000\n255\n"), HasSubstr("more than 100 million pixels"));
  EXPECT_THAT(with_image("P5\n-3 10\n255\n"), HasSubstr("PGM header"));
  EXPECT_THAT(with_image("P5\n2 2\n65536\n12345678"), HasSubstr("maximum 65536; expected 1 to 65535"));
  EXPECT_THAT(with_image("P5\n2 2\n65535\n1234567"), HasSubstr("PGM cut off: 7 of 8 bytes"));
  EXPECT_THAT(with_image("P2\n2 2\n255\n1 2 3\n"), HasSubstr("pixel 3 is missing"));
  EXPECT_THAT(with_image("\x89PNG\r\n\x1a\nnothing"), HasSubstr("broken PNG"));
  EXPECT_THAT(with_image(std::string("P5\n2 2\n255\n") + std::string(4, '\0')), HasSubstr("no free pixel"));
}

TEST(ImageWorld, ReadsWhatThePictureWrites) {
  Picture picture({{0.0, 0.0}, {1.0, 0.5}}, 0.1);
  picture.dot({0.05, 0.45}, {0, 0, 0});
  const auto file = folder() / "small.png";
  ASSERT_TRUE(picture.save_png(file).has_value());
  const auto image = read_image(file);
  ASSERT_TRUE(image.has_value());
  EXPECT_EQ(image->width, 10);
  EXPECT_EQ(image->height, 5);
  EXPECT_EQ(image->pixels[0], 0);  // upper left
  EXPECT_EQ(image->pixels[1], 255);
}

struct SceneFault {
  const char* text;
  const char* expected;
};

class SceneFaults : public testing::TestWithParam<SceneFault> {};

TEST_P(SceneFaults, AreNamedWithTheirPlace) {
  EXPECT_THAT(message(World::from_scene_text(GetParam().text, "s.toml")), HasSubstr(GetParam().expected));
}

INSTANTIATE_TEST_SUITE_P(
    All, SceneFaults,
    testing::Values(
        SceneFault{"", "s.toml:1:1: scene: nothing is drawn"},
        SceneFault{"[[wall]]\npoints_m = [[0.0, 0.0], [1.0, 0.0]]\n", "no [[start]]"},
        SceneFault{"[[wall]]\npoints_m = [[0.0, 0.0], [nan, 0.0]]\n",
                   "s.toml:2:26: [[wall]]: 'points_m' is nan; expected a number from -1000 to 1000"},
        SceneFault{"[[wall]]\npoints_m = [[0.0, 0.0]]\n", "expected 2 points [x, y] or more"},
        SceneFault{"[[wall]]\npoints_m = [[0.0, 0.0], [1.0]]\n", "expected a point [x, y] in metres"},
        SceneFault{"[[wall]]\npoints_m = [[0.0, 0.0], [0.0, 0.0]]\n", "has point 0 twice"},
        SceneFault{"[[wall]]\nthickness_m = 0.1\n", "'points_m' is missing"},
        SceneFault{
            "[[box]]\ncenter_m = [0.0, 0.0]\nlength_m = 1\nwidth_m = 1\nz_min_m = 1.0\nz_max_m = 0.5\n",
            "s.toml:6:11: [[box]]: 'z_max_m' is 0.5; expected more than z_min_m, which is 1"},
        SceneFault{"[[box]]\ncenter_m = [0.0, 0.0]\nlength_m = 'x'\nwidth_m = 1\nz_max_m = 0.5\n",
                   "s.toml:3:12: [[box]]: 'length_m' is 'x'"},
        SceneFault{"colour = 3\n",
                   "s.toml:1:1: scene: unknown key 'colour'; expected one of name, ceiling_m"},
        SceneFault{"wall = 3\n", "'wall' is no list of tables"},
        SceneFault{"[[wall]\n", "s.toml:1:8: no TOML"},
        SceneFault{"[[start]]\nx_m = 0.5\ny_m = 0.5\n[[box]]\ncenter_m = [0.5, 0.5]\nlength_m = 1\nwidth_m = "
                   "1\nz_max_m = 1.0\n",
                   "s.toml:2:7: [[start]]: 'x_m' puts the start (0.5, 0.5) inside something solid"},
        SceneFault{"[[start]]\nx_m = 90.5\ny_m = 0.5\n[[box]]\ncenter_m = [0.5, 0.5]\nlength_m = 1\nwidth_m "
                   "= 1\nz_max_m = 1.0\n",
                   "outside of everything drawn"},
        SceneFault{"[[wall]]\npoints_m = [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0]]\nopenings = [{ at_m = 3.0, "
                   "width_m = 1.0 }]\n",
                   "s.toml:3:12: [[wall]]: 'openings' from 2.5 to 3.5 m overlaps another or a corner"},
        SceneFault{"[[wall]]\npoints_m = [[0.0, 0.0], [3.0, 0.0]]\nalcoves = [{ at_m = 9.0, width_m = 1.0, "
                   "depth_m = 0.3 }]\n",
                   "beyond the wall, which is 3 m long"},
        SceneFault{"[[wall]]\npoints_m = [[0.0, 0.0], [3.0, 0.0]]\nalcoves = [{ at_m = 1.0, width_m = 1.0, "
                   "depth_m = 0.3, side = 'up' }]\n",
                   "'side' is 'up'; expected one of left, right"},
        SceneFault{"[[clutter]]\nfrom_m = [0.0, 0.0]\nto_m = [3.0, 0.0]\nheight_m = [2.0, 1.0]\n",
                   "expected the smaller number first"},
        SceneFault{"[[glass]]\npoints_m = [[0.0, 0.0], [3.0, 0.0]]\ntransmission = 1.5\n",
                   "expected a number from 0 to 1"}));

TEST(SceneWorld, TellsAllFaultsAtOnce) {
  const std::string text = message(World::from_scene_text(
      "colour = 3\n[[wall]]\nthickness_m = 9.0\n[[cylinder]]\nradius_m = -1.0\n", "s.toml"));
  EXPECT_THAT(text, HasSubstr("s.toml:1:1"));
  EXPECT_THAT(text, HasSubstr("s.toml:2:1"));
  EXPECT_THAT(text, HasSubstr("s.toml:5:12"));
}

TEST(SceneWorld, OpeningsLintelsAndAlcovesAreWhereTheyAreDrawn) {
  const World world = scene(room_text() + R"([[wall]]
points_m = [[5.0, 0.0], [5.0, 6.0]]
thickness_m = 0.2
openings = [{ at_m = 1.5, width_m = 1.0, lintel_m = 2.0 }]
alcoves = [{ at_m = 4.5, width_m = 1.0, depth_m = 0.5, side = "right" }]
)");
  EXPECT_NEAR(world.level_range_m(3.0, 1.5, 0.3, 0.0), 5.0, 1e-9);   // through the door
  EXPECT_NEAR(world.level_range_m(3.0, 1.5, 2.2, 0.0), 1.9, 1e-9);   // at the lintel
  EXPECT_NEAR(world.level_range_m(3.0, 3.0, 0.3, 0.0), 1.9, 1e-9);   // at the wall
  EXPECT_NEAR(world.level_range_m(3.0, 4.5, 0.3, 0.0), 2.4, 1e-9);   // into the niche
  EXPECT_NEAR(world.level_range_m(3.0, 1.01, 0.3, 0.0), 5.0, 1e-9);  // the door's full width
  EXPECT_NEAR(world.level_range_m(3.0, 0.99, 0.3, 0.0), 1.9, 1e-9);
}

TEST(Area, ADiscReachesWhatIsWideEnoughAndSeesBeyond) {
  // Two rooms of 4 x 6 m, a gap of 0.4 m between them: seen through, not passed.
  const World world = scene(room_text() + R"([[wall]]
points_m = [[4.0, 0.0], [4.0, 6.0]]
thickness_m = 0.1
openings = [{ at_m = 3.0, width_m = 0.4 }]
[[box]]
center_m = [1.0, 5.0]
length_m = 0.5
width_m = 0.5
z_max_m = 0.8
)");
  const ReachableArea area = reachable_area(world, {2.0, 3.0}, 0.3);
  EXPECT_EQ(area.poses.at(Vector2(6.0, 3.0)), 0);
  EXPECT_NE(area.poses.at(Vector2(3.6, 3.0)), 0);
  EXPECT_EQ(area.poses.at(Vector2(3.9, 1.0)), 0);  // nearer to the wall than the disc is wide
  EXPECT_NE(area.visible.at(Vector2(7.9, 3.0)), 0);
  EXPECT_EQ(area.visible.at(Vector2(4.3, 5.8)), 0);
  EXPECT_EQ(area.visible.at(Vector2(1.0, 5.0)), 0);
  EXPECT_GT(area.visible.area_m2(), 4.0 * 6.0 - 1.0);
  const ReachableArea slim = reachable_area(world, {2.0, 3.0}, 0.15);
  EXPECT_NE(slim.poses.at(Vector2(6.0, 3.0)), 0);
}

std::filesystem::path world_file(const char* name) {
  return std::filesystem::path(TOPO_SOURCE_DIR) / "config/worlds" / name;
}

TEST(DrawnWorlds, EveryRoomOfTheOfficeCanBeEntered) {
  const auto world = World::load(world_file("office.toml"));
  ASSERT_TRUE(world.has_value()) << message(world);
  ASSERT_EQ(world->start_poses().size(), 3U);
  EXPECT_EQ(world->glass().size(), 1U);
  // With the wider of the two robots and a hand's breadth to spare.
  const Raster poses = reachable_poses(world->structure(), world->start_poses()[0].translation(),
                                       RobotModel::p3at().swing_radius_m + 0.05);
  for (const Vector2& room :
       {Vector2(3.0, 4.5), Vector2(13.0, 4.5), Vector2(21.0, 3.0), Vector2(5.5, 10.5), Vector2(13.0, 10.5),
        Vector2(20.0, 12.0), Vector2(6.0, 15.5), Vector2(13.0, 15.5), Vector2(20.0, 15.5), Vector2(30.0, 9.0),
        Vector2(38.0, 10.5), Vector2(32.0, 17.5), Vector2(38.5, 16.5), Vector2(4.0, 24.0),
        Vector2(20.0, 23.0), Vector2(20.0, 27.5), Vector2(13.0, 31.0), Vector2(40.5, 13.0)}) {
    EXPECT_NE(poses.at(room), 0) << room.transpose();
  }
  EXPECT_EQ(poses.at(Vector2(34.0, 25.0)), 0);  // outside
}

// Things stand along 60 % of the walls or more: of the places 4 cm before a wall's upper part that one can
// see, those that are taken further down.
TEST(DrawnWorlds, ThingsStandAlongMostWallsOfTheOffice) {
  const auto world = World::load(world_file("office.toml"));
  ASSERT_TRUE(world.has_value()) << message(world);
  const Raster poses = reachable_poses(world->structure(), world->start_poses()[0].translation(), 0.267);
  const Raster upper = world->free_mask(2.15, 2.25);
  int along = 0;
  int taken = 0;
  for (int y = 1; y + 1 < upper.height; ++y) {
    for (int x = 1; x + 1 < upper.width; ++x) {
      if (upper.at(x, y) == 0) continue;
      const bool at_wall = upper.at(x - 1, y) == 0 || upper.at(x + 1, y) == 0 || upper.at(x, y - 1) == 0 ||
                           upper.at(x, y + 1) == 0;
      if (!at_wall) continue;
      bool indoors = false;
      for (int dy = -16; dy <= 16 && !indoors; dy += 4)
        for (int dx = -16; dx <= 16; dx += 4) indoors = indoors || poses.at(x + dx, y + dy) != 0;
      if (!indoors) continue;
      ++along;
      taken += world->structure().at(x, y) == 0 ? 1 : 0;
    }
  }
  const double part = static_cast<double>(taken) / along;
  RecordProperty("part_of_walls_with_clutter", std::to_string(part));
  EXPECT_GE(part, 0.6);
  EXPECT_LE(part, 0.8);
}

TEST(DrawnWorlds, TheCourseHasFourRoomsAndALoop) {
  const auto world = World::load(world_file("course.toml"));
  ASSERT_TRUE(world.has_value()) << message(world);
  const Raster poses = reachable_poses(world->structure(), world->start_poses()[0].translation(),
                                       RobotModel::p3at().swing_radius_m + 0.05);
  for (const Vector2& place :
       {Vector2(6.2, 4.5), Vector2(14.0, 3.8), Vector2(5.0, 10.0), Vector2(13.0, 10.0), Vector2(1.1, 7.5),
        Vector2(18.9, 7.5), Vector2(10.0, 13.9), Vector2(10.0, 1.1)}) {
    EXPECT_NE(poses.at(place), 0) << place.transpose();
  }
}

TEST(FloorPlans, LoadAndAreClosed) {
  const char* data = std::getenv("TOPOMETRIC_DATA");
  if (data == nullptr) GTEST_SKIP() << "TOPOMETRIC_DATA is not set";
  for (const char* name : {"loop", "aaf_y3", "cumberland"}) {
    const auto world =
        World::load(std::filesystem::path(data) / "floorplans" / (std::string(name) + ".yaml"));
    ASSERT_TRUE(world.has_value()) << message(world);
    const Se2 start = world->start_poses()[0];
    for (int i = 0; i < 3600; ++i) {
      RayOptions far;
      far.range_max_m = 1000.0;
      ASSERT_LT(world->level_range_m(start.x_m, start.y_m, 2.0, 0.1 * i, far), 200.0) << name;
    }
    EXPECT_GT(reachable_poses(world->structure(), start.translation(), 0.267).area_m2(), 100.0);
  }
}

}  // namespace
}  // namespace topo::sim

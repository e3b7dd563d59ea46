// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/table/table_world.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/sim/area.hpp"
#include "tests/sim/robot_model.hpp"
#include "tests/sim/team_start.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"

namespace topo::bench {
namespace {

using daemon::testing::TempDir;
namespace fs = std::filesystem;

std::string room_text(double width_m) {
  return fmt::format(
      "name = \"room\"\n[[start]]\nx_m = 1.0\ny_m = 0.8\n[[wall]]\n"
      "points_m = [[0.0, 0.0], [{0}, 0.0], [{0}, 6.0], [0.0, 6.0]]\nclosed = true\nthickness_m = 0.2\n",
      width_m);
}

TableWorld loaded(const std::string& file, int seeds, bool drawn, int team) {
  auto world = load_table_world(file, seeds, drawn, team);
  EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().message);
  return std::move(*world);
}

TEST(TableWorld, drawsStartsThatDependOnTheSeedAlone) {
  const TempDir folder;
  const std::string file = folder.write("room.toml", room_text(12.0));
  const TableWorld eight = loaded(file, 8, true, 1), three = loaded(file, 3, true, 3);
  ASSERT_EQ(eight.starts.size(), 8U);
  EXPECT_EQ(eight.starts.front(), (sim::Se2{1.0, 0.8, 0.0})) << "the world's own";
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(eight.starts[i], three.starts[i]) << "however many seeds and robots there are";
  std::set<std::pair<double, double>> different;
  for (const sim::Se2& start : eight.starts) different.emplace(start.x_m, start.y_m);
  EXPECT_EQ(different.size(), 8U);
}

TEST(TableWorld, hasRoomForATeamAtEveryStart) {
  const TempDir folder;
  const std::string file = folder.write("room.toml", room_text(12.0));
  const auto world = sim::World::load(file);
  ASSERT_TRUE(world.has_value());
  const double radius_m = sim::RobotModel::p3dx().swing_radius_m;
  const sim::Raster poses = sim::reachable_area(*world, {1.0, 0.8}, radius_m).poses;
  for (std::uint64_t seed = 2; seed < 40; ++seed) {
    const auto start = start_of_seed(*world, poses, {1.0, 0.8, 0.0}, seed);
    ASSERT_TRUE(start.has_value()) << start.error().message;
    EXPECT_NE(poses.at(start->translation()), 0);
    EXPECT_TRUE(sim::has_room(*world, *start));
    EXPECT_TRUE(sim::team_starts(*world, *start, kStartTeam).has_value());
  }
}

TEST(TableWorld, canHaveItsOwnStartWithAllSeeds) {
  const TempDir folder;
  const TableWorld world = loaded(folder.write("room.toml", room_text(9.0)), 3, false, 1);
  EXPECT_EQ(world.starts, std::vector<sim::Se2>(3, {1.0, 0.8, 0.0}));
  EXPECT_NEAR(world.reachable_m2, 8.8 * 5.8, 2.0);
  EXPECT_EQ(world.name, "room");
}

TEST(TableWorld, isAnotherBuildingWhenItIsDrawnAnew) {
  const TempDir folder;
  const std::string a = loaded(folder.write("room.toml", room_text(9.0)), 1, false, 1).building;
  EXPECT_EQ(loaded(folder.write("room.toml", room_text(9.0)), 1, false, 1).building, a);
  EXPECT_NE(loaded(folder.write("room.toml", room_text(9.1)), 1, false, 1).building, a);
}

TEST(TableWorld, startsWhereTheListBesideItSays) {
  const TempDir folder;
  const std::string file = folder.write("room.toml", room_text(9.0));
  (void)folder.write("WORLDS.tsv", "name\tm2\tstart_x_m\tstart_y_m\nhall\t1\t9\t9\nroom\t50\t4.5\t3.25\n");
  EXPECT_EQ(loaded(file, 1, true, 1).starts.front(), (sim::Se2{4.5, 3.25, 0.0}));
  (void)folder.write("WORLDS.tsv", "name\tstart_x_m\tstart_y_m\nroom\tfour\t3.25\n");
  const auto no_number = load_table_world(file, 1, true, 1);
  ASSERT_FALSE(no_number.has_value());
  EXPECT_NE(no_number.error().message.find("room: expected metres"), std::string::npos)
      << no_number.error().message;
  (void)folder.write("WORLDS.tsv", "name\tx\ty\nroom\t4\t3\n");
  const auto no_column = load_table_world(file, 1, true, 1);
  ASSERT_FALSE(no_column.has_value());
  EXPECT_NE(no_column.error().message.find("start_x_m"), std::string::npos) << no_column.error().message;
}

TEST(TableWorld, saysWhenItIsTooSmall) {
  const TempDir folder;
  const auto world = load_table_world(folder.write("room.toml", room_text(2.0)), 1, true, 8);
  ASSERT_FALSE(world.has_value());
  EXPECT_NE(world.error().message.find("expected 8"), std::string::npos) << world.error().message;
}

TEST(WorldFiles, areThoseOfFoldersInTheOrderOfTheirNames) {
  const TempDir folder;
  for (const char* name : {"b.yaml", "a.toml", "c.yml", "a.png", "WORLDS.tsv"}) (void)folder.write(name, "");
  const std::vector<fs::path> given{folder.str()};
  const auto files = world_files(given);
  ASSERT_TRUE(files.has_value()) << files.error().message;
  ASSERT_EQ(files->size(), 3U);
  EXPECT_EQ((*files)[0].filename(), "a.toml");
  EXPECT_EQ((*files)[2].filename(), "c.yml");
}

TEST(WorldFiles, ofOneNameAreRefusedAndSoIsAnEmptyFolder) {
  const TempDir one, other, empty;
  const std::vector<fs::path> same{one.write("a.toml", ""), other.write("a.yaml", "")};
  const auto twice = world_files(same);
  ASSERT_FALSE(twice.has_value());
  EXPECT_NE(twice.error().message.find("the same name"), std::string::npos);
  const std::vector<fs::path> nothing{empty.str()};
  const auto none = world_files(nothing);
  ASSERT_FALSE(none.has_value());
  EXPECT_NE(none.error().message.find("found no worlds"), std::string::npos);
}

}  // namespace
}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's basement (figure 9): two corridors that cross, walls hidden behind clutter. Its rooms and
// corridors are places of their own, and of a map that ends in three corridors and before two rooms the goals
// are few and miss none. With TOPOMETRIC_OUT in the environment the map with places and goals becomes
// basement.png there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <vector>

#include "core/analysis/analysis.hpp"
#include "core/grid/distance.hpp"
#include "daemon/mapfile/overview.hpp"
#include "daemon/mapfile/picture.hpp"
#include "tests/sim/area.hpp"
#include "tests/sim/world.hpp"

namespace topo {
namespace {

using types::Vector2;

const std::vector<Vector2> kRooms{{8.5, 17.0}, {36.5, 8.0}, {55.0, 26.5}, {26.0, 39.5}};
const std::vector<Vector2> kArms{{10.0, 21.3}, {60.0, 21.3}, {31.3, 5.0}, {31.3, 34.0}};

/// What a level scanner that was everywhere knows: free what it saw, occupied what stands beside that.
grid::DenseMap map_of(const sim::World& world, const sim::Raster& visible) {
  const sim::Raster free = world.free_mask(0.29, 0.31);
  grid::DenseMap map;
  map.resolution_m = visible.resolution_m;
  const grid::CellIndex low = map.cell_at(visible.center(0, 0));
  map.box = {{low.x - 1, low.y - 1}, {low.x + visible.width, low.y + visible.height}};
  map.cells.assign(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()),
                   grid::CellState::kUnknown);
  for (int y = 0; y < visible.height; ++y) {
    for (int x = 0; x < visible.width; ++x) {
      grid::CellState& cell = map.cells[map.index({low.x + x, low.y + y})];
      if (visible.at(x, y) != 0) cell = grid::CellState::kFree;
      bool beside = false;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        beside = beside || visible.at(x + dx, y + dy) != 0;
      if (visible.at(x, y) == 0 && beside && free.at(visible.center(x, y)) == 0)
        cell = grid::CellState::kOccupied;
    }
  }
  return map;
}

analysis::Analysis analysis_of(const grid::DenseMap& map) {
  const std::vector<float> clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  return analysis::analyse({1, map, clearance_m, {}, {}}, {});
}

std::uint16_t place_at(const analysis::Analysis& a, const Vector2& p) {
  return a.places.labels[a.map.index(a.map.cell_at(p))];
}

class Basement : public ::testing::Test {
 protected:
  void SetUp() override {
    auto loaded =
        sim::World::load(std::filesystem::path(TOPOMETRIC_SOURCE_DIR) / "config/worlds/basement.toml");
    ASSERT_TRUE(loaded.has_value()) << loaded.error().message;
    const Vector2 start = loaded->start_poses().front().translation();
    map_ = map_of(*loaded, sim::reachable_area(*loaded, start, 0.3).visible);
  }

  grid::DenseMap map_;
};

TEST_F(Basement, RoomsAndCorridorsArePlacesOfTheirOwn) {
  const analysis::Analysis whole = analysis_of(map_);
  std::set<std::uint16_t> rooms, arms;
  for (const Vector2& room : kRooms) {
    rooms.insert(place_at(whole, room));
    EXPECT_EQ(place_at(whole, room + Vector2(1.0, 1.0)), place_at(whole, room)) << room.transpose();
  }
  for (const Vector2& arm : kArms) arms.insert(place_at(whole, arm));
  EXPECT_EQ(rooms.size(), kRooms.size()) << "no two rooms are one place";
  EXPECT_FALSE(rooms.contains(0));
  for (const std::uint16_t arm : arms) EXPECT_FALSE(rooms.contains(arm)) << "a room is no corridor";
  EXPECT_LE(whole.places.places.size(), 30U) << "115 m of corridors, four rooms, nine alcoves";
  EXPECT_TRUE(whole.goals.goals.empty()) << "nothing is left to explore";
}

TEST_F(Basement, GoalsOfAPartialMapAreFewAndMissNoCorridor) {
  const std::vector<Vector2> ends{{50.0, 21.3}, {31.3, 34.0}, {31.3, 12.0}};
  for (std::size_t i = 0; i < map_.cells.size(); ++i) {
    const Vector2 p = map_.centre_of(map_.cell(i));
    const bool room = p.y() < 20.0 && p.x() < 30.0;
    if (p.x() > ends[0].x() || p.y() > ends[1].y() || (p.y() < ends[2].y() && p.x() > 29.0) || room)
      map_.cells[i] = grid::CellState::kUnknown;
  }
  const analysis::Analysis part = analysis_of(map_);
  const std::vector<goals::Goal>& goals = part.goals.goals;
  if (const char* folder = std::getenv("TOPOMETRIC_OUT"); folder != nullptr)
    (void)daemon::save_png((std::filesystem::path(folder) / "basement.png").string(),
                           daemon::overview_of(part, {}, {}));
  for (const Vector2& end : ends) {
    EXPECT_TRUE(
        std::ranges::any_of(goals, [&](const goals::Goal& g) { return (g.opening - end).norm() < 1.5; }))
        << "the corridor goes on at " << end.transpose();
  }
  EXPECT_TRUE(std::ranges::any_of(goals, [](const goals::Goal& g) {
    return (g.opening - Vector2(8.5, 20.0)).norm() < 1.5;
  })) << "the door of the south-west room";
  EXPECT_LE(goals.size(), 6U);
}

}  // namespace
}  // namespace topo

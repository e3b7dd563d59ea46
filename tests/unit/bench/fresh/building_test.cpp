// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/fresh/building.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "tests/bench/topobench/fresh/doors.hpp"
#include "tests/bench/topobench/fresh/draw_floor.hpp"
#include "tests/bench/topobench/fresh/suite.hpp"
#include "tests/sim/area.hpp"
#include "tests/sim/team_start.hpp"
#include "tests/unit/daemon/support/temp_dir.hpp"
#include "tests/unit/support/times.hpp"

namespace topo::bench::fresh {
namespace {

constexpr std::size_t kBuildings = test::times(200, 40);
constexpr std::size_t kDrawnAgain = test::times(20, 4);

/// The same for every property: drawing them is most of the time.
const std::vector<Building>& buildings() {
  static const std::vector<Building> kAll = [] {
    std::vector<Building> all;
    for (std::size_t i = 1; i <= kBuildings; ++i) {
      auto building = draw_building(seed_of_building(99, static_cast<int>(i)));
      if (building) all.push_back(std::move(*building));
    }
    return all;
  }();
  return kAll;
}

TEST(FreshBuilding, existsForEverySeed) { EXPECT_EQ(buildings().size(), kBuildings); }

TEST(FreshBuilding, hasAnAreaInTheRange) {
  double least_m2 = HUGE_VAL, most_m2 = 0.0;
  for (const Building& building : buildings()) {
    const double area_m2 = building.free.area_m2();
    EXPECT_GE(area_m2, kAreaMin_m2);
    EXPECT_LE(area_m2, kAreaMax_m2);
    least_m2 = std::min(least_m2, area_m2);
    most_m2 = std::max(most_m2, area_m2);
  }
  EXPECT_LT(least_m2, 400.0) << "small ones are among them";
  EXPECT_GT(most_m2, 2200.0) << "and large ones";
}

TEST(FreshBuilding, isOneConnectedFloor) {
  for (const Building& building : buildings()) {
    const sim::Raster reached =
        sim::reachable_poses(building.free, building.start.translation(), 0.5 * kCell_m);
    EXPECT_EQ(reached.cells, building.free.cells);
  }
}

TEST(FreshBuilding, letsTheRobotIntoEveryRoom) {
  for (const Building& building : buildings()) {
    const sim::Raster poses =
        sim::reachable_poses(building.free, building.start.translation(), kRobotRadius_m);
    for (const SpaceCells& space : cells_of_spaces(building.plan, building.free)) {
      const bool gets_in = std::any_of(space.cells.begin(), space.cells.end(),
                                       [&](std::size_t cell) { return poses.cells[cell] != 0; });
      EXPECT_TRUE(gets_in) << "wing " << space.wing << ", space " << space.space;
    }
  }
}

TEST(FreshBuilding, hasDoorsOfThePermittedWidths) {
  std::size_t doors = 0;
  for (const Building& building : buildings()) {
    for (const Wing& wing : building.plan.wings) {
      for (const Door& door : wing.doors) {
        EXPECT_GE(door.width_m(), kDoorMin_m - 1e-9);
        const Use a = wing.spaces[door.a].use, b = wing.spaces[door.b].use;
        EXPECT_NE(a, Use::kClosed);
        EXPECT_NE(b, Use::kClosed);
        // Corridors, lobbies and alcoves are open along all of their wall.
        if (a != Use::kCorridor && b != Use::kCorridor) {
          EXPECT_LE(door.width_m(), kDoorMax_m + 1e-9);
        }
        ++doors;
      }
    }
  }
  EXPECT_GT(doors, 20 * kBuildings);
}

/// A door that is not turned keeps its width in the image, to the cell.
TEST(FreshBuilding, drawsADoorAsWideAsPlanned) {
  std::size_t checked = 0;
  for (const Building& building : buildings()) {
    for (const Wing& wing : building.plan.wings) {
      if (wing.T_building_wing.theta_rad != 0.0) continue;
      for (const Door& door : wing.doors) {
        const sim::Vector2 at = wing.T_building_wing.translation();
        const sim::Raster& free = building.free;
        const int x0 = free.column(at.x() + door.gap.x0 + 0.01),
                  x1 = free.column(at.x() + door.gap.x1 - 0.01);
        const int y0 = free.row(at.y() + door.gap.y0 + 0.01), y1 = free.row(at.y() + door.gap.y1 - 0.01);
        const int across = door.along_x ? y1 - y0 + 1 : x1 - x0 + 1;
        EXPECT_EQ(across, static_cast<int>(std::lround(door.width_m() / kCell_m)));
        for (int y = y0; y <= y1; ++y) {
          for (int x = x0; x <= x1; ++x) EXPECT_NE(free.at(x, y), 0);
        }
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 5 * kBuildings);
}

TEST(FreshBuilding, hasAClosedOuterWall) {
  for (const Building& building : buildings()) {
    const sim::Raster& free = building.free;
    for (int x = 0; x < free.width; ++x) {
      for (const int y : {0, 1, 2, free.height - 3, free.height - 2, free.height - 1})
        EXPECT_EQ(free.at(x, y), 0);
    }
    for (int y = 0; y < free.height; ++y) {
      for (const int x : {0, 1, 2, free.width - 3, free.width - 2, free.width - 1})
        EXPECT_EQ(free.at(x, y), 0);
    }
  }
}

TEST(FreshBuilding, isTheSameForTheSameSeed) {
  std::set<std::size_t> different;
  for (std::size_t i = 1; i <= kDrawnAgain; ++i) {
    const auto again = draw_building(seed_of_building(99, static_cast<int>(i)));
    ASSERT_TRUE(again.has_value()) << again.error().message;
    const Building& first = buildings()[i - 1];
    EXPECT_EQ(again->free.cells, first.free.cells);
    EXPECT_EQ(again->start, first.start);
    different.insert(first.free.cells.size());
  }
  EXPECT_GE(5 * different.size(), 4 * kDrawnAgain) << "another building for another seed";
}

/// A large office floor has corridors that cross.
TEST(FreshBuilding, hasCorridorsThatMeet) {
  std::size_t several = 0, meet = 0;
  for (const Building& building : buildings()) {
    for (const Wing& wing : building.plan.wings) {
      const auto corridors = std::count_if(wing.spaces.begin(), wing.spaces.end(),
                                           [](const Space& space) { return space.use == Use::kCorridor; });
      if (corridors < 2) continue;
      ++several;
      meet += std::any_of(wing.doors.begin(), wing.doors.end(),
                          [&](const Door& door) {
                            return wing.spaces[door.a].use == Use::kCorridor &&
                                   wing.spaces[door.b].use == Use::kCorridor;
                          })
                  ? 1U
                  : 0U;
    }
  }
  EXPECT_GT(10 * several, 3 * kBuildings);
  EXPECT_GT(10 * meet, 8 * several);
}

TEST(FreshBuilding, hasEveryKindOfPlan) {
  std::size_t skew = 0, several = 0, halls = 0, closed = 0;
  for (const Building& building : buildings()) {
    const auto& wings = building.plan.wings;
    const auto has = [&](Use use) {
      return std::any_of(wings.begin(), wings.end(), [&](const Wing& wing) {
        return std::any_of(wing.spaces.begin(), wing.spaces.end(),
                           [&](const Space& s) { return s.use == use; });
      });
    };
    several += wings.size() > 1 ? 1U : 0U;
    skew += std::any_of(wings.begin(), wings.end(),
                        [](const Wing& wing) {
                          const double quarters = wing.T_building_wing.theta_rad / (0.5 * std::numbers::pi);
                          return std::abs(quarters - std::round(quarters)) > 0.05;
                        })
                ? 1U
                : 0U;
    halls += has(Use::kHall) ? 1U : 0U;
    closed += has(Use::kClosed) ? 1U : 0U;
  }
  EXPECT_GT(10 * several, 2 * kBuildings);
  EXPECT_GT(10 * skew, kBuildings);
  EXPECT_GT(10 * halls, 3 * kBuildings);
  EXPECT_GT(10 * closed, 3 * kBuildings);
}

TEST(FreshSuite, writesPlansThatTheSimulatorReads) {
  const daemon::testing::TempDir folder;
  const auto files = write_fresh_suite(7, 6, folder.str());
  ASSERT_TRUE(files.has_value()) << files.error().message;
  ASSERT_EQ(files->size(), 6U);
  EXPECT_EQ(files->front().filename(), "fresh-7-01.yaml");
  for (int i = 1; i <= 6; ++i) {
    const auto building = draw_building(seed_of_building(7, i));
    const auto world = sim::World::load((*files)[static_cast<std::size_t>(i - 1)]);
    ASSERT_TRUE(building.has_value() && world.has_value());
    EXPECT_EQ(world->structure().width, building->free.width);
    const sim::Se2 start = world->start_poses().front();
    EXPECT_NEAR((start.translation() - building->start.translation()).norm(), 0.0, 2e-3);
    EXPECT_TRUE(sim::has_room(*world, start));
    EXPECT_TRUE(sim::team_starts(*world, start, 3).has_value()) << "room for a team";
  }
}

TEST(FreshSuite, namesWhatItCannotDraw) {
  const daemon::testing::TempDir folder;
  const auto files = write_fresh_suite(7, 0, folder.str());
  ASSERT_FALSE(files.has_value());
  EXPECT_NE(files.error().message.find("found 0, expected 1 to 200"), std::string::npos);
}

TEST(DevSuite, namesThePlanThatIsMissing) {
  const daemon::testing::TempDir folder;
  const auto files = dev_suite(folder.str());
  ASSERT_FALSE(files.has_value());
  EXPECT_NE(files.error().message.find("aaf_y3.yaml"), std::string::npos);
}

}  // namespace
}  // namespace topo::bench::fresh

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/analysis.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/grid/distance.hpp"
#include "core/places/segmentation/furniture.hpp"
#include "core/places/skeleton/erosion.hpp"
#include "core/travel/coarse_map.hpp"

namespace topo::analysis {
namespace {

using grid::CellState;
using grid::DenseMap;

void fill(DenseMap& map, int x0, int y0, int x1, int y1, CellState state) {
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) map.cells[map.index({x, y})] = state;
}

/// Two rows of rooms along a corridor, with doors, and things that stand about.
DenseMap building() {
  DenseMap map;
  map.box = {{0, 0}, {199, 119}};
  map.cells.assign(static_cast<std::size_t>(map.width() * map.height()), CellState::kUnknown);
  fill(map, 8, 8, 192, 112, CellState::kOccupied);
  fill(map, 10, 50, 190, 70, CellState::kFree);
  for (int x = 10; x < 190; x += 36) {
    for (const int y : {10, 72}) fill(map, x, y, x + 34, y + 38, CellState::kFree);
    for (const int y : {48, 70}) fill(map, x + 12, y, x + 24, y + 2, CellState::kFree);
  }
  for (int k = *rc::gen::inRange(0, 30); k > 0; --k) {
    const int x = *rc::gen::inRange(12, 180), y = *rc::gen::inRange(12, 100);
    fill(map, x, y, x + *rc::gen::inRange(1, 8), y + *rc::gen::inRange(1, 8), CellState::kOccupied);
  }
  return map;
}

/// What a robot has come to know of a building.
class Exploration {
 public:
  explicit Exploration(DenseMap building) : building_(std::move(building)), seen_(building_) {
    std::fill(seen_.cells.begin(), seen_.cells.end(), CellState::kUnknown);
  }

  void look_around(int x, int y, int reach) {
    at_.push_back(building_.centre_of({x, y}));
    for (std::size_t i = 0; i < seen_.cells.size(); ++i) {
      const grid::CellIndex c = building_.cell(i);
      if ((c.x - x) * (c.x - x) + (c.y - y) * (c.y - y) <= reach * reach) seen_.cells[i] = building_.cells[i];
    }
  }
  /// As a snapshot has it: no greater than what is known.
  [[nodiscard]] AnalysisInput input(std::uint64_t revision) {
    grid::CellBox known;
    for (std::size_t i = 0; i < seen_.cells.size(); ++i)
      if (seen_.cells[i] != CellState::kUnknown) known.extend(seen_.cell(i));
    DenseMap map;
    map.resolution_m = seen_.resolution_m;
    map.box = {{known.min.x - 1, known.min.y - 1}, {known.max.x + 1, known.max.y + 1}};
    map.cells.resize(static_cast<std::size_t>(map.width() * map.height()));
    for (std::size_t i = 0; i < map.cells.size(); ++i) map.cells[i] = seen_.state(map.cell(i));
    clearance_m_ = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    return {revision, std::move(map), clearance_m_, {}, {at_}};
  }

 private:
  DenseMap building_, seen_;
  std::vector<types::Vector2> at_;
  std::vector<float> clearance_m_;  ///< of the newest input
};

/// As a wall store has them: not of all that is occupied, and in another order than the map's.
std::vector<types::Vector2> some_occupied(const DenseMap& map) {
  std::vector<types::Vector2> points;
  const std::size_t left_out = *rc::gen::inRange<std::size_t>(2, 9);
  for (std::size_t i = map.cells.size(); i-- > 0;)
    if (map.cells[i] == CellState::kOccupied && i % left_out != 0)
      points.push_back(map.centre_of(map.cell(i)));
  return points;
}

/// A coarse map comes with distances that are not those between its own cells: skeleton and places follow
/// the ones given.
TEST(Analysis, OfACoarseMapIsByTheDistancesGiven) {
  EXPECT_TRUE(rc::check([] {
    Exploration exploration(building());
    exploration.look_around(*rc::gen::inRange(10, 190), *rc::gen::inRange(10, 110),
                            *rc::gen::inRange(20, 60));
    AnalysisInput input = exploration.input(1);
    const travel::CoarseMap wide = travel::coarser(input.map, input.clearance_m);
    input.map = wide.map;
    input.clearance_m = wide.clearance_m;
    const Analysis a = analyse(input, {});
    if (places::without_furniture(wide.map, a.walls, places::PlaceParams{}.furniture_m).cells !=
        wide.map.cells)
      return;
    const places::Skeleton expected =
        places::skeletonise(wide.map, wide.clearance_m, places::erode(wide.map, wide.clearance_m));
    RC_ASSERT(a.skeleton.on == expected.on);
    RC_ASSERT(a.skeleton.axis == expected.axis);
  }));
}

TEST(Analysis, OfTheSameMapIsTheSame) {
  EXPECT_TRUE(rc::check([] {
    Exploration exploration(building());
    exploration.look_around(*rc::gen::inRange(10, 190), *rc::gen::inRange(10, 110),
                            *rc::gen::inRange(10, 60));
    AnalysisInput input = exploration.input(1);
    if (*rc::gen::inRange(0, 3) == 0) input.wall_points = some_occupied(input.map);
    const Analysis one = analyse(input, {}), other = analyse(input, {});
    RC_ASSERT(one.compass.angle_rad == other.compass.angle_rad);
    RC_ASSERT(one.skeleton.axis == other.skeleton.axis);
    RC_ASSERT(one.places.labels == other.places.labels);
    RC_ASSERT(one.goals.goals.size() == other.goals.goals.size());
  }));
}

void check_places(const places::PlaceMap& a, const places::PlaceMap& b) {
  RC_ASSERT(a.labels == b.labels);
  RC_ASSERT(a.places.size() == b.places.size());
  for (std::size_t p = 0; p < a.places.size(); ++p) {
    RC_ASSERT(a.places[p].box.min == b.places[p].box.min && a.places[p].box.max == b.places[p].box.max);
    RC_ASSERT(a.places[p].centroid == b.places[p].centroid);
  }
  RC_ASSERT(a.borders.size() == b.borders.size());
  for (std::size_t k = 0; k < a.borders.size(); ++k) {
    RC_ASSERT(a.borders[k].a == b.borders[k].a && a.borders[k].b == b.borders[k].b);
    RC_ASSERT(a.borders[k].length_m == b.borders[k].length_m);
  }
}

void check_goals(const std::vector<goals::Goal>& a, const std::vector<goals::Goal>& b) {
  RC_ASSERT(a.size() == b.size());
  for (std::size_t g = 0; g < a.size(); ++g)
    RC_ASSERT(a[g].p_map == b[g].p_map && a[g].place == b[g].place && a[g].verdict == b[g].verdict);
}

/// A building of which much was seen.
AnalysisInput explored(Exploration& exploration) {
  for (const auto& [x, y] : {std::pair(30, 60), std::pair(90, 60), std::pair(60, 40), std::pair(150, 60)})
    exploration.look_around(x, y, 50);
  return exploration.input(7);
}

std::vector<Stage> stages_of(const std::function<void(const StageWatch&)>& analysed) {
  std::vector<Stage> stages;
  analysed([&](Stage stage) { stages.push_back(stage); });
  return stages;
}

TEST(Analysis, TellsEachStageOnceInItsOrder) {
  EXPECT_TRUE(rc::check([] {
    const std::vector<Stage> all{Stage::kCompass, Stage::kWalls,     Stage::kFurniture, Stage::kSkeleton,
                                 Stage::kLabels,  Stage::kReduction, Stage::kGoals};
    Exploration exploration(building());
    const AnalysisInput input = explored(exploration);
    RC_ASSERT(stages_of([&](const StageWatch& done) { (void)analyse(input, {}, done); }) == all);
    RC_ASSERT(stages_of([&](const StageWatch& done) { (void)analyse({}, {}, done); }) == all);
  }));
}

TEST(Analysis, OfNoMapIsEmpty) {
  AnalysisInput input;
  input.revision = 11;
  const Analysis none = analyse(input, {});
  EXPECT_EQ(none.revision, 11U);
  EXPECT_FALSE(none.compass.angle_rad);
  EXPECT_TRUE(none.walls.empty() && none.skeleton.axis.empty() && none.places.places.empty());
  EXPECT_TRUE(none.goals.goals.empty() && none.goals.rejected.empty());
  EXPECT_TRUE(clearance_of(none).empty());
}

TEST(Analysis, IsOfTheMapThatWasGiven) {
  EXPECT_TRUE(rc::check([] {
    Exploration exploration(building());
    const AnalysisInput input = explored(exploration);
    const Analysis a = analyse(input, {});
    RC_ASSERT(a.revision == 7U);
    RC_ASSERT(a.map.box == input.map.box && a.map.cells == input.map.cells);
    RC_ASSERT(a.coarse_m.empty());
    RC_ASSERT(std::ranges::equal(clearance_of(a), input.clearance_m));
    Analysis coarse = a;
    coarse.coarse_m.assign(a.map.cells.size(), 0.25F);
    RC_ASSERT(clearance_of(coarse) == coarse.coarse_m);
  }));
}

TEST(Analysis, WithoutTheWallStoreItsPointsDoNotCount) {
  EXPECT_TRUE(rc::check([] {
    Exploration exploration(building());
    AnalysisInput input = explored(exploration);
    AnalysisParams ablation;
    ablation.wall_store = false;
    const Analysis bare = analyse(input, {});
    input.wall_points = {{0.0, 0.0}};  // no walls
    const Analysis told = analyse(input, {}), untold = analyse(input, ablation);
    RC_ASSERT(told.walls.empty());
    RC_ASSERT(!bare.walls.empty());
    RC_ASSERT(untold.walls.size() == bare.walls.size());
    for (std::size_t w = 0; w < bare.walls.size(); ++w)
      RC_ASSERT(untold.walls[w].a == bare.walls[w].a && untold.walls[w].b == bare.walls[w].b);
    check_places(untold.places, bare.places);
    check_goals(untold.goals.goals, bare.goals.goals);
  }));
}

TEST(Analysis, ItsPartsAgreeWithEachOther) {
  std::size_t places = 0, goals = 0;
  EXPECT_TRUE(rc::check([&] {
    Exploration exploration(building());
    AnalysisParams params;
    params.goals.worth_min = 0.01;  // nearly every opening is worth a goal
    const Analysis a = analyse(explored(exploration), params);
    std::vector<std::size_t> cells_of(a.places.places.size() + 1, 0);
    for (std::size_t i = 0; i < a.map.cells.size(); ++i) {
      const std::uint16_t label = a.places.labels[i];
      RC_ASSERT(label < cells_of.size());
      RC_ASSERT(label == 0 || a.map.cells[i] == CellState::kFree);
      RC_ASSERT(!a.skeleton.on[i] || a.map.cells[i] != CellState::kUnknown);
      ++cells_of[label];
    }
    for (std::size_t p = 1; p < cells_of.size(); ++p) RC_ASSERT(cells_of[p] > 0U);
    for (const places::PlaceBorder& border : a.places.borders) {
      RC_ASSERT(border.a < border.b && border.b < a.places.places.size());
      RC_ASSERT(border.length_m > 0.0);
    }
    for (const goals::Goal& goal : a.goals.goals) {
      RC_ASSERT(goal.verdict == goals::Verdict::kAccepted);
      RC_ASSERT(a.map.state(a.map.cell_at(goal.p_map)) == CellState::kFree);
      RC_ASSERT(goal.place <= a.places.places.size());
    }
    for (const goals::Goal& goal : a.goals.rejected) RC_ASSERT(goal.verdict != goals::Verdict::kAccepted);
    places += a.places.places.size();
    goals += a.goals.goals.size();
  }));
  EXPECT_GT(places, 100U);
  EXPECT_GT(goals, 50U);
}

/// The building's walls are along the axes, and nothing of it is turned.
TEST(Analysis, FindsTheWallsAlongTheCompass) {
  EXPECT_TRUE(rc::check([] {
    Exploration exploration(building());
    const Analysis a = analyse(explored(exploration), {});
    RC_ASSERT(a.compass.angle_rad.has_value());
    RC_ASSERT(std::abs(std::remainder(*a.compass.angle_rad, std::numbers::pi / 2.0)) < 0.01);
    RC_ASSERT(a.walls.size() > 3U);
    for (const types::Segment& wall : a.walls) {
      const types::Vector2 way = (wall.b - wall.a).normalized();
      RC_ASSERT(std::min(std::abs(way.x()), std::abs(way.y())) < 0.05);
    }
  }));
}

}  // namespace
}  // namespace topo::analysis

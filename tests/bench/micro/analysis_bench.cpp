// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What each stage of the analysis costs on a building of the paper's size: 1.26 million cells of 0.05 m, a
// quarter of them known. `cells_ns` is per known cell; `passes` is how often one could have copied the map's
// cells.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>

#include "core/goals/essential_goals.hpp"
#include "core/goals/frontiers.hpp"
#include "core/grid/distance.hpp"
#include "core/grid/wavefront.hpp"
#include "core/places/place_map.hpp"
#include "core/places/skeleton.hpp"
#include "core/walls/compass.hpp"
#include "core/walls/wall_extraction.hpp"
#include "tests/bench/micro/fixture.hpp"

namespace topo::bench {
namespace {

using grid::CellIndex;
using grid::CellState;
using grid::DenseMap;

/// A grid drawn by hand: corridors in a ring with rooms along them, doors, clutter, and rooms not seen yet.
class Building {
 public:
  /// `scale` times as many corridors to each side: known cells grow with its square.
  explicit Building(int scale) : grid_(arena_, 0.05) {
    // The map's corners are known, so that it has the paper's size whatever is drawn.
    set({0, 0}, CellState::kOccupied);
    set({kWidth * scale - 3, kHeight * scale - 3}, CellState::kOccupied);
    for (int block_y = 0; block_y < scale; ++block_y)
      for (int block_x = 0; block_x < scale; ++block_x) draw_block({block_x * kWidth, block_y * kHeight});
  }

  [[nodiscard]] const grid::OccupancyGrid& grid() const { return grid_; }

  static constexpr int kWidth = 1400;
  static constexpr int kHeight = 900;
  static constexpr CellIndex kInCorridor{220, 120};

 private:
  void set(CellIndex c, CellState state) {
    const int tx = c.x >> 5, ty = c.y >> 5;
    grid::CellCounts& cell =
        grid_.tile_to_change(tx, ty).cells[grid::Tile::index(c.x - tx * 32, c.y - ty * 32)];
    cell = state == CellState::kOccupied ? grid::CellCounts{3, 1} : grid::CellCounts{0, 4};
  }

  /// Free inside, walls two cells thick around.
  void draw_room(CellIndex min, CellIndex max) {
    for (int y = min.y; y <= max.y; ++y) {
      for (int x = min.x; x <= max.x; ++x) {
        const bool wall = x < min.x + 2 || x > max.x - 2 || y < min.y + 2 || y > max.y - 2;
        set({x, y}, wall ? CellState::kOccupied : CellState::kFree);
      }
    }
  }

  void free_rectangle(CellIndex min, CellIndex max) {
    for (int y = min.y; y <= max.y; ++y)
      for (int x = min.x; x <= max.x; ++x) set({x, y}, CellState::kFree);
  }

  void clutter(CellIndex min, CellIndex max) {
    std::uniform_int_distribution<int> x(min.x + 4, max.x - 12), y(min.y + 4, max.y - 12), size(1, 8);
    for (int i = 0; i < (max.x - min.x) * (max.y - min.y) / 700; ++i) {
      const CellIndex at{x(random_), y(random_)};
      for (int dy = size(random_); dy >= 0; --dy)
        for (int dx = size(random_); dx >= 0; --dx) set({at.x + dx, at.y + dy}, CellState::kOccupied);
    }
  }

  /// A ring of corridor of 2.4 m, 50 m by 35 m, with rooms along its long sides; every seventh is unseen.
  void draw_block(CellIndex o) {
    for (int i = 0; i < 13; ++i) {
      for (const int y : {20, 750}) {
        if (++room_ % 7 == 0) continue;
        const CellIndex min{o.x + 180 + i * 80, o.y + y}, max{min.x + 81, min.y + 81};
        draw_room(min, max);
        clutter(min, max);
      }
    }
    const CellIndex min{o.x + 180, o.y + 100}, max{o.x + 1220, o.y + 750};
    draw_room({min.x, min.y}, {max.x, min.y + 50});
    draw_room({min.x, max.y - 50}, {max.x, max.y + 1});
    draw_room({min.x, min.y}, {min.x + 50, max.y});
    draw_room({max.x - 50, min.y}, {max.x, max.y});
    for (const int x : {min.x + 2, max.x - 48}) free_rectangle({x, min.y + 2}, {x + 46, max.y - 2});
    for (const int y : {min.y + 2, max.y - 48}) free_rectangle({min.x + 2, y}, {max.x - 2, y + 46});
    for (int i = 0; i < 13; ++i) {
      for (const int y : {98, 748})
        free_rectangle({o.x + 200 + i * 80, o.y + y}, {o.x + 219 + i * 80, o.y + y + 6});
    }
  }

  patricia::Arena<grid::TileRef> arena_;
  grid::OccupancyGrid grid_;
  std::mt19937 random_{1};
  int room_ = 0;
};

/// What every stage needs of those before it.
struct Stages {
  explicit Stages(int scale) : building(scale) {
    map = grid::dense_map(building.grid());
    clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    points = walls::occupied_points(map);
    compass_rad = walls::entropy_compass(points).angle_rad.value_or(0.0);
    walls = walls::extract_walls(points, compass_rad);
    skeleton = places::skeletonise(map, clearance_m);
    places = places::segment_places(map, clearance_m, skeleton, walls, compass_rad);
    known = static_cast<double>(map.cells.size()) -
            static_cast<double>(std::count(map.cells.begin(), map.cells.end(), CellState::kUnknown));
  }

  Building building;
  DenseMap map;
  std::vector<float> clearance_m;
  std::vector<types::Vector2> points;
  double compass_rad = 0.0;
  std::vector<types::Segment> walls;
  places::Skeleton skeleton;
  places::PlaceMap places;
  double known = 0.0;
};

const Stages& stages(std::int64_t scale) {
  static const Stages paper(1);
  static const Stages four(4);
  return scale == 1 ? paper : four;
}

/// One stage, over and over, beside the copy of the cells.
template <class F>
void measure(benchmark::State& state, F&& stage) {
  const Stages& on = stages(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(stage(on));
  // Seconds an iteration by these numbers, in processor time.
  const auto per = benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  state.counters["s_per_known"] = benchmark::Counter(on.known, per);
  state.counters["passes"] = benchmark::Counter(memcpy_seconds(on.map.cells.size()), per);
}

void BM_DenseMap(benchmark::State& state) {
  measure(state, [](const Stages& on) { return grid::dense_map(on.building.grid()); });
  state.counters["cells"] = static_cast<double>(stages(state.range(0)).map.cells.size());
  state.counters["known"] = stages(state.range(0)).known;
}
void BM_Clearance(benchmark::State& state) {
  measure(state,
          [](const Stages& on) { return grid::clearance_m(on.map, grid::Boundary::kOccupiedOrUnknown); });
}
void BM_ClearanceUnknownOpen(benchmark::State& state) {
  measure(state, [](const Stages& on) { return grid::clearance_m(on.map, grid::Boundary::kOccupied); });
}
void BM_Wavefront(benchmark::State& state) {
  measure(state,
          [](const Stages& on) { return travel_field(on.map, on.clearance_m, Building::kInCorridor, {}); });
}
void BM_Frontiers(benchmark::State& state) {
  measure(state, [](const Stages& on) { return goals::find_frontiers(on.map); });
}
void BM_OccupiedPoints(benchmark::State& state) {
  measure(state, [](const Stages& on) { return walls::occupied_points(on.map); });
}
void BM_Compass(benchmark::State& state) {
  measure(state, [](const Stages& on) { return walls::entropy_compass(on.points); });
  state.counters["points"] = static_cast<double>(stages(state.range(0)).points.size());
}
void BM_Walls(benchmark::State& state) {
  measure(state, [](const Stages& on) { return walls::extract_walls(on.points, on.compass_rad); });
  state.counters["walls"] = static_cast<double>(stages(state.range(0)).walls.size());
}
void BM_Skeleton(benchmark::State& state) {
  measure(state, [](const Stages& on) { return places::skeletonise(on.map, on.clearance_m); });
}
void BM_Places(benchmark::State& state) {
  measure(state, [](const Stages& on) {
    return places::segment_places(on.map, on.clearance_m, on.skeleton, on.walls, on.compass_rad);
  });
  state.counters["places"] = static_cast<double>(stages(state.range(0)).places.places.size());
}
void BM_Goals(benchmark::State& state) {
  measure(state, [](const Stages& on) {
    return goals::essential_goals({on.map, on.clearance_m, on.skeleton, on.places, {}});
  });
}
BENCHMARK(BM_DenseMap)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Clearance)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_ClearanceUnknownOpen)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Wavefront)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Frontiers)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_OccupiedPoints)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Compass)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Walls)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Skeleton)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Places)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_Goals)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace topo::bench

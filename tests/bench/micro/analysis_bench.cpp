// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What each stage of the analysis costs on buildings of 1, 4, 16 and 49 times the paper's size: 1.26 million
// cells of 0.05 m, a quarter of them known. `per_known` is time per known cell; `passes` how often one could
// have read the map's cells; `peak_B` the memory that a stage asks for at most, and `kept_B` its result, in
// bytes per known cell.
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include "core/analysis/analysis.hpp"
#include "core/compass/compass.hpp"
#include "core/compass/occupied_points.hpp"
#include "core/goals/essential_goals.hpp"
#include "core/goals/frontiers.hpp"
#include "core/grid/clearance_update.hpp"
#include "core/grid/distance.hpp"
#include "core/grid/wavefront.hpp"
#include "core/places/segmentation/furniture.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/places/segmentation/segment_places.hpp"
#include "core/places/skeleton/skeleton.hpp"
#include "core/walls/wall_extraction.hpp"
#include "tests/bench/micro/drawn_building.hpp"
#include "tests/bench/micro/memory_gauge.hpp"

namespace topo::bench {
namespace {

using grid::DenseMap;

/// What every stage needs of those before it.
struct Stages {
  explicit Stages(int scale) : building(scale) {
    map = grid::dense_map(building.grid());
    clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    points = compass::occupied_points(map);
    compass_rad = compass::entropy_compass(points).angle_rad.value_or(0.0);
    walls = walls::extract_walls(points, compass_rad);
    open = places::without_furniture(map, walls, params.furniture_m);
    open_m = grid::clearance_m(open, grid::Boundary::kOccupiedOrUnknown);
    skeleton = places::skeletonise(open, open_m);
    first = places::first_labels(open, open_m, skeleton, params.first);
    places = places::reduce_labels(open, open_m, first, walls, compass_rad, params);
    places.labels = places.labels.on_free_cells(map);
    known = static_cast<double>(map.cells.size()) -
            static_cast<double>(std::count(map.cells.begin(), map.cells.end(), CellState::kUnknown));
  }

  places::PlaceParams params;
  Building building;
  DenseMap map, open;
  std::vector<float> clearance_m, open_m;
  std::vector<types::Vector2> points;
  double compass_rad = 0.0;
  std::vector<types::Segment> walls;
  places::Skeleton skeleton;
  places::FirstLabels first;
  places::PlaceMap places;
  double known = 0.0;
};

/// Of the size asked for last: the greatest takes gigabytes.
const Stages& stages(std::int64_t scale) {
  static std::int64_t made = 0;
  static std::unique_ptr<const Stages> present;
  if (made != scale) {
    present.reset();
    present = std::make_unique<const Stages>(static_cast<int>(scale));
    made = scale;
  }
  return *present;
}

/// Seconds that reading the map's cells once takes, best of nine.
double pass_seconds(const DenseMap& map) {
  double best = HUGE_VAL;
  for (int i = 0; i < 9; ++i) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(std::count(map.cells.begin(), map.cells.end(), CellState::kFree));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
  }
  return best;
}

/// One stage, over and over, beside a pass over the cells.
template <class F>
void measure(benchmark::State& state, F&& stage) {
  const Stages& on = stages(state.range(0));
  const auto before = static_cast<double>(live_bytes());
  double peak = 0.0, kept = 0.0;
  for (auto _ : state) {
    reset_peak();
    const auto result = stage(on);
    benchmark::DoNotOptimize(&result);
    peak = static_cast<double>(peak_bytes()) - before;
    kept = static_cast<double>(live_bytes()) - before;
  }
  // Seconds an iteration by these numbers, in processor time.
  const auto per = benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
  state.counters["per_known"] = benchmark::Counter(on.known, per);
  state.counters["passes"] = benchmark::Counter(pass_seconds(on.map), per);
  state.counters["peak_B"] = peak / on.known;
  state.counters["kept_B"] = kept / on.known;
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
  measure(state, [](const Stages& on) { return compass::occupied_points(on.map); });
}
void BM_Compass(benchmark::State& state) {
  measure(state, [](const Stages& on) { return compass::entropy_compass(on.points); });
}
void BM_Walls(benchmark::State& state) {
  measure(state, [](const Stages& on) { return walls::extract_walls(on.points, on.compass_rad); });
}
void BM_Furniture(benchmark::State& state) {
  measure(state, [](const Stages& on) {
    return places::without_furniture(on.map, on.walls, on.params.furniture_m);
  });
}
void BM_Erosion(benchmark::State& state) {
  measure(state, [](const Stages& on) { return places::erode(on.open, on.open_m); });
}
void BM_Skeleton(benchmark::State& state) {
  measure(state, [](const Stages& on) { return places::skeletonise(on.open, on.open_m); });
}
void BM_Labels(benchmark::State& state) {
  measure(state, [](const Stages& on) {
    return places::first_labels(on.open, on.open_m, on.skeleton, on.params.first);
  });
}
void BM_Reduction(benchmark::State& state) {
  measure(state, [](const Stages& on) {
    return places::reduce_labels(on.open, on.open_m, on.first, on.walls, on.compass_rad, on.params);
  });
}
void BM_Goals(benchmark::State& state) {
  measure(state, [](const Stages& on) {
    const std::vector<types::Segment> continued = goals::continued_walls(on.map, on.walls);
    return goals::essential_goals({on.map, on.clearance_m, on.skeleton, on.places, continued, {}});
  });
}

/// From the map to the goals, distances included.
void BM_Whole(benchmark::State& state) {
  measure(state, [](const Stages& on) {
    const std::vector<float> clearance_m = grid::clearance_m(on.map, grid::Boundary::kOccupiedOrUnknown);
    return analysis::analyse({1, on.map, clearance_m, {}, {}}, {});
  });
}

constexpr std::array kStages = {BM_DenseMap,  BM_Clearance, BM_ClearanceUnknownOpen,
                                BM_Wavefront, BM_Frontiers, BM_OccupiedPoints,
                                BM_Compass,   BM_Walls,     BM_Furniture,
                                BM_Erosion,   BM_Skeleton,  BM_Labels,
                                BM_Reduction, BM_Goals,     BM_Whole};
constexpr std::array kNames = {"DenseMap",  "Clearance", "ClearanceUnknownOpen",
                               "Wavefront", "Frontiers", "OccupiedPoints",
                               "Compass",   "Walls",     "Furniture",
                               "Erosion",   "Skeleton",  "Labels",
                               "Reduction", "Goals",     "Whole"};
static_assert(kStages.size() == kNames.size());

}  // namespace
}  // namespace topo::bench

/// Size by size, so that each building is drawn once.
int main(int argc, char** argv) {
  for (const int scale : {1, 2, 4, 7}) {
    for (std::size_t i = 0; i < topo::bench::kStages.size(); ++i) {
      benchmark::RegisterBenchmark(topo::bench::kNames[i], topo::bench::kStages[i])
          ->Arg(scale)
          ->MinWarmUpTime(0.01)
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

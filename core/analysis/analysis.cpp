// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/analysis.hpp"

#include <algorithm>
#include <utility>

#include "core/analysis/incremental_analysis.hpp"
#include "core/compass/occupied_points.hpp"
#include "core/grid/clearance_update.hpp"
#include "core/grid/distance.hpp"
#include "core/places/segmentation/furniture.hpp"
#include "core/places/segmentation/segment_places.hpp"
#include "core/places/skeleton/erosion.hpp"
#include "core/walls/wall_extraction.hpp"

namespace topo::analysis {

/// State that the wall search of one map leaves to the next.
struct WallSearchMemory {
  compass::CompassMemory compass;
  std::vector<types::Vector2> wall_points;  ///< of the wall store; empty: the walls are those of the occupied
                                            ///< cells
  walls::WallMemory walls;
};

/// State that one analysis leaves to the next.
struct IncrementalAnalysis::Memory {
  compass::OccupiedPoints occupied;
  WallSearchMemory walls;
  places::FurnitureUpdate furniture;
  grid::ClearanceUpdate open;  ///< of the map without furniture
  places::Erosion erosion;
  bool is_own = false;  ///< erosion and labels use the distances of `open`
  places::FirstLabels first;
  places::ReductionMemory reduction;
};

namespace {

/// The map without furniture, and its distances.
struct OpenMap {
  const grid::DenseMap& map;
  std::span<const float> clearance_m;
};

/// The stages of one analysis. For furniture and first labels there is one version for a single map and one
/// for updates.
class Stages {
 public:
  Stages(AnalysisInput input, const AnalysisParams& params, const StageWatch& done)
      : params_(params),
        done_(done),
        clearance_m_(input.clearance_m),
        wall_points_(std::move(input.wall_points)),
        visited_(std::move(input.visited)) {
    a_.revision = input.revision;
    a_.map = std::move(input.map);
  }

  [[nodiscard]] const grid::DenseMap& map() const { return a_.map; }

  void find_walls(const compass::PointsChange& occupied, WallSearchMemory& memory) {
    compass::CompassParams compass = params_.compass;
    compass.cell_m = a_.map.resolution_m;
    a_.compass = compass::entropy_compass(occupied, compass, memory.compass);
    tell(Stage::kCompass);
    // The walls of the store are reliable. Without a coronal scanner there are none, and the occupied cells
    // replace them.
    if (!params_.wall_store) wall_points_.clear();
    if (wall_points_.empty() != memory.wall_points.empty()) memory.walls = {};  // came from other points
    const compass::PointsChange store = compass::points_change(memory.wall_points, wall_points_);
    a_.walls = walls::extract_walls(store.now.empty() ? occupied : store, compass_rad(), params_.walls,
                                    memory.walls);
    memory.wall_points = std::move(wall_points_);
    tell(Stage::kWalls);
  }
  void find_walls() {
    const std::vector<types::Vector2> occupied = compass::occupied_points(a_.map);
    WallSearchMemory none;
    find_walls({occupied, {}, {}}, none);
  }
  [[nodiscard]] grid::DenseMap without_furniture() const {
    return places::without_furniture(a_.map, a_.walls, params_.places.furniture_m);
  }
  /// The occupied points, and their change since the previous map.
  [[nodiscard]] compass::PointsChange take_map(places::FurnitureUpdate& furniture,
                                               compass::OccupiedPoints& occupied) const {
    return occupied.take(a_.map, furniture.take(a_.map, params_.places.furniture_m));
  }
  [[nodiscard]] const grid::DenseMap& without_furniture(places::FurnitureUpdate& furniture) const {
    return furniture.clear(a_.map, a_.walls);
  }
  void find_skeleton(const OpenMap& open, const places::Erosion& erosion) {
    a_.skeleton = places::skeletonise(open.map, open.clearance_m, erosion);
    tell(Stage::kSkeleton);
  }
  [[nodiscard]] places::FirstLabels first_labels(const OpenMap& open) const {
    return places::first_labels(open.map, open.clearance_m, a_.skeleton, params_.places.piece_m);
  }
  void relabel(const OpenMap& open, std::span<const std::uint32_t> changed,
               places::FirstLabels& first) const {
    places::relabel(open.map, open.clearance_m, a_.skeleton, params_.places.piece_m, changed, first);
  }
  /// `occupied`: the change of the open map since the one in `memory`, when it consists of occupied cells
  /// only.
  void find_places_and_goals(const OpenMap& open, const places::FirstLabels& first,
                             const grid::OccupiedChange& occupied, places::ReductionMemory& memory) {
    tell(Stage::kLabels);
    a_.places = places::reduce_labels(open.map, open.clearance_m, first, a_.walls, compass_rad(),
                                      params_.places, occupied, memory);
    a_.places.labels = a_.places.labels.on_free_cells(a_.map);  // not on cells of furniture
    tell(Stage::kReduction);
    a_.goals =
        goals::essential_goals({a_.map, clearance_m_, a_.skeleton, a_.places, visited_}, params_.goals);
    tell(Stage::kGoals);
  }
  void tell(Stage stage) const {
    if (done_) done_(stage);
  }

  Analysis take() { return std::move(a_); }

 private:
  [[nodiscard]] double compass_rad() const { return a_.compass.angle_rad.value_or(0.0); }

  const AnalysisParams& params_;
  const StageWatch& done_;
  std::span<const float> clearance_m_;
  std::vector<types::Vector2> wall_points_;
  std::vector<std::vector<types::Vector2>> visited_;
  Analysis a_;
};

}  // namespace

std::vector<float> clearance_of(const Analysis& analysis) {
  if (!analysis.coarse_m.empty()) return analysis.coarse_m;
  return grid::clearance_m(analysis.map, grid::Boundary::kOccupiedOrUnknown);
}

Analysis analyse(AnalysisInput input, const AnalysisParams& params, const StageWatch& done) {
  std::span<const float> open_m = input.clearance_m;
  Stages stages(std::move(input), params, done);
  stages.find_walls();
  const grid::DenseMap map = stages.without_furniture();
  std::vector<float> without_m;
  if (map.cells != stages.map().cells)
    open_m = without_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
  stages.tell(Stage::kFurniture);
  const OpenMap open{map, open_m};
  stages.find_skeleton(open, places::erode(map, open_m));
  places::FirstLabels first = stages.first_labels(open);
  first.slopes = {};  // unused: nothing is labelled again
  places::ReductionMemory no_regions;
  stages.find_places_and_goals(open, first, {}, no_regions);
  return stages.take();
}

IncrementalAnalysis::IncrementalAnalysis() : memory_(std::make_unique<Memory>()) {}
IncrementalAnalysis::~IncrementalAnalysis() = default;

Analysis IncrementalAnalysis::take(AnalysisInput input, const AnalysisParams& params,
                                   const StageWatch& done) {
  Memory& memory = *memory_;
  const std::span<const float> given_m = input.clearance_m;
  Stages stages(std::move(input), params, done);
  stages.find_walls(stages.take_map(memory.furniture, memory.occupied), memory.walls);
  const grid::DenseMap& map = stages.without_furniture(memory.furniture);
  memory.open.take(map, memory.furniture.others());
  // The distances given with a coarse map are not its own: they apply when there is no furniture.
  const std::span<const float> own_m = memory.open.clearance_m();
  const bool is_own = map.cells != stages.map().cells || std::ranges::equal(own_m, given_m);
  const OpenMap open{map, is_own ? own_m : given_m};
  const auto& changed = memory.open.changed();
  const bool was_own = std::exchange(memory.is_own, is_own);
  stages.tell(Stage::kFurniture);
  const bool again = is_own && was_own && changed;
  memory.erosion = again ? places::erode_again(map, own_m, std::move(memory.erosion), *changed)
                         : places::erode(map, open.clearance_m);
  stages.find_skeleton(open, memory.erosion);
  if (again && memory.first.box == map.box)
    stages.relabel(open, *changed, memory.first);
  else
    memory.first = stages.first_labels(open);
  stages.find_places_and_goals(open, memory.first, memory.open.occupied(), memory.reduction);
  return stages.take();
}

}  // namespace topo::analysis

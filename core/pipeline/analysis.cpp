// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/analysis.hpp"

#include <utility>

#include "core/grid/distance.hpp"
#include "core/places/furniture.hpp"

namespace topo::pipeline {
namespace {

/// The map without furniture, with its distances.
struct OpenMap {
  const grid::DenseMap& map;
  const std::vector<float>& clearance_m;
};

/// The stages from the compass to the furniture, and those behind: what lies between is done in two ways.
class Stages {
 public:
  Stages(AnalysisInput input, const AnalysisParams& params, const StageWatch& done)
      : params_(params),
        done_(done),
        wall_points_(std::move(input.wall_points)),
        visited_(std::move(input.visited)) {
    a_.revision = input.revision;
    a_.map = std::move(input.free.map);
    a_.clearance_m = std::move(input.free.clearance_m);
  }

  [[nodiscard]] const Analysis& so_far() const { return a_; }

  void find_walls() {
    // The store's walls are the confident ones; without a coronal scanner there are none, and what is
    // occupied must do.
    const std::vector<types::Vector2> occupied = walls::occupied_points(a_.map);
    walls::CompassParams compass = params_.compass;
    compass.cell_m = a_.map.resolution_m;
    a_.compass = walls::entropy_compass(occupied, compass);
    tell(Stage::kCompass);
    const bool has_store = !wall_points_.empty() && params_.wall_store;
    a_.walls = walls::extract_walls(has_store ? wall_points_ : occupied, compass_rad(), params_.walls);
    tell(Stage::kWalls);
  }
  [[nodiscard]] grid::DenseMap without_furniture() const {
    return places::without_furniture(a_.map, a_.walls, params_.places.furniture_m);
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
  void find_places_and_goals(const OpenMap& open, const places::FirstLabels& first) {
    tell(Stage::kLabels);
    a_.places = places::reduce_labels(open.map, open.clearance_m, a_.skeleton, first, a_.walls, compass_rad(),
                                      params_.places);
    places::leave_free_space(a_.map, a_.places.labels);
    tell(Stage::kReduction);
    a_.goals =
        goals::essential_goals({a_.map, a_.clearance_m, a_.skeleton, a_.places, visited_}, params_.goals);
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
  std::vector<types::Vector2> wall_points_;
  std::vector<std::vector<types::Vector2>> visited_;
  Analysis a_;
};

}  // namespace

Analysis analyse(AnalysisInput input, const AnalysisParams& params, const StageWatch& done) {
  Stages stages(std::move(input), params, done);
  stages.find_walls();
  const grid::DenseMap open = stages.without_furniture();
  std::vector<float> without_m;
  if (open.cells != stages.so_far().map.cells)
    without_m = grid::clearance_m(open, grid::Boundary::kOccupiedOrUnknown);
  const std::vector<float>& open_m = without_m.empty() ? stages.so_far().clearance_m : without_m;
  stages.tell(Stage::kFurniture);
  stages.find_skeleton({open, open_m}, places::erode(open, open_m));
  stages.find_places_and_goals({open, open_m}, stages.first_labels({open, open_m}));
  return stages.take();
}

Analysis analyse(AnalysisInput input, const AnalysisParams& params, AnalysisMemory& memory,
                 const StageWatch& done) {
  Stages stages(std::move(input), params, done);
  stages.find_walls();
  const grid::DenseMap open = stages.without_furniture();
  memory.open.take(open);
  // A coarse map's distances are not its own: they count where there is no furniture.
  const Analysis& given = stages.so_far();
  const bool is_own = open.cells != given.map.cells || memory.open.clearance_m() == given.clearance_m;
  const std::vector<float>& open_m = is_own ? memory.open.clearance_m() : given.clearance_m;
  const auto& changed = memory.open.changed();
  const bool was_own = std::exchange(memory.is_own, is_own);
  stages.tell(Stage::kFurniture);
  const bool again = is_own && was_own && changed;
  memory.erosion =
      again ? places::erode_again(open, open_m, memory.erosion, *changed) : places::erode(open, open_m);
  stages.find_skeleton({open, open_m}, memory.erosion);
  if (again && memory.first.box == open.box)
    stages.relabel({open, open_m}, *changed, memory.first);
  else
    memory.first = stages.first_labels({open, open_m});
  stages.find_places_and_goals({open, open_m}, memory.first);
  return stages.take();
}

}  // namespace topo::pipeline

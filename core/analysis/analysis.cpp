// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/analysis/analysis.hpp"

#include <span>
#include <utility>

#include "core/compass/occupied_points.hpp"
#include "core/grid/distance.hpp"
#include "core/places/segmentation/furniture.hpp"
#include "core/places/segmentation/segment_places.hpp"
#include "core/places/skeleton/erosion.hpp"
#include "core/walls/wall_extraction.hpp"

namespace topo::analysis {
namespace {

/// The walls of the store are reliable. Without a coronal scanner there are none, and the occupied cells
/// replace them.
std::span<const types::Vector2> points_of_walls(const AnalysisInput& input, const AnalysisParams& params,
                                                std::span<const types::Vector2> occupied) {
  if (!params.wall_store || input.wall_points.empty()) return occupied;
  return input.wall_points;
}

}  // namespace

std::vector<float> clearance_of(const Analysis& analysis) {
  if (!analysis.coarse_m.empty()) return analysis.coarse_m;
  return grid::clearance_m(analysis.map, grid::Boundary::kOccupiedOrUnknown);
}

Analysis analyse(AnalysisInput input, const AnalysisParams& params, const StageWatch& done) {
  const auto finished = [&](Stage stage) {
    if (done) done(stage);
  };
  Analysis a;
  a.revision = input.revision;
  a.map = std::move(input.map);

  compass::CompassParams compass = params.compass;
  compass.cell_m = a.map.resolution_m;
  const std::vector<types::Vector2> occupied = compass::occupied_points(a.map);
  a.compass = compass::entropy_compass(occupied, compass);
  const double compass_rad = a.compass.angle_rad.value_or(0.0);
  finished(Stage::kCompass);

  const std::span<const types::Vector2> wall_points = points_of_walls(input, params, occupied);
  a.walls = walls::extract_walls(wall_points, compass_rad, params.walls);
  if (a.compass.angle_rad) {
    Wings wings =
        skew_wings(occupied, wall_points, compass_rad, a.walls, compass, params.walls, params.wings);
    a.wings_rad = std::move(wings.directions_rad);
    a.walls.insert(a.walls.end(), wings.walls.begin(), wings.walls.end());
  }
  finished(Stage::kWalls);

  const grid::DenseMap open = places::without_furniture(a.map, a.walls, params.places.furniture_m);
  // The distances that were given apply when there is no furniture.
  std::vector<float> own_m;
  std::span<const float> clearance_m = input.clearance_m;
  if (open.cells != a.map.cells)
    clearance_m = own_m = grid::clearance_m(open, grid::Boundary::kOccupiedOrUnknown);
  finished(Stage::kFurniture);

  a.skeleton = places::skeletonise(open, clearance_m, places::erode(open, clearance_m), params.skeleton);
  finished(Stage::kSkeleton);

  const places::FirstLabels first = places::first_labels(open, clearance_m, a.skeleton, params.places.first);
  finished(Stage::kLabels);

  a.places = places::reduce_labels(open, clearance_m, first, a.walls, compass_rad, params.places);
  a.places.labels = a.places.labels.on_free_cells(a.map);  // not on cells of furniture
  finished(Stage::kReduction);

  a.continued = goals::continued_walls(a.map, a.walls, params.goals.continued);
  a.goals = goals::essential_goals(
      {a.map, input.clearance_m, a.skeleton, a.places, a.continued, input.visited}, params.goals);
  finished(Stage::kGoals);
  return a;
}

}  // namespace topo::analysis

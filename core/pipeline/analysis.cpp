// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/analysis.hpp"

#include "core/grid/distance.hpp"
#include "core/places/furniture.hpp"

namespace topo::pipeline {

Analysis analyse(AnalysisInput input, const AnalysisParams& params, const StageWatch& done) {
  const auto tell = [&](Stage stage) {
    if (done) done(stage);
  };
  Analysis a;
  a.revision = input.revision;
  a.map = std::move(input.free.map);
  a.clearance_m = std::move(input.free.clearance_m);
  // The store's walls are the confident ones; without a coronal scanner there are none, and what is occupied
  // must do.
  std::vector<types::Vector2> points = std::move(input.wall_points);
  const std::vector<types::Vector2> occupied = walls::occupied_points(a.map);
  walls::CompassParams compass = params.compass;
  compass.cell_m = a.map.resolution_m;
  a.compass = walls::entropy_compass(occupied, compass);
  tell(Stage::kCompass);
  if (points.empty() || !params.wall_store) points = occupied;
  const double compass_rad = a.compass.angle_rad.value_or(0.0);
  a.walls = walls::extract_walls(points, compass_rad, params.walls);
  tell(Stage::kWalls);
  const grid::DenseMap open = places::without_furniture(a.map, a.walls, params.places.furniture_m);
  std::vector<float> without_m;
  if (open.cells != a.map.cells) without_m = grid::clearance_m(open, grid::Boundary::kOccupiedOrUnknown);
  const std::vector<float>& open_m = without_m.empty() ? a.clearance_m : without_m;
  tell(Stage::kFurniture);
  a.skeleton = places::skeletonise(open, open_m);
  tell(Stage::kSkeleton);
  const places::FirstLabels first = places::first_labels(open, open_m, a.skeleton, params.places.piece_m);
  tell(Stage::kLabels);
  a.places = places::reduce_labels(open, open_m, a.skeleton, first, a.walls, compass_rad, params.places);
  places::leave_free_space(a.map, a.places.labels);
  tell(Stage::kReduction);
  a.goals = goals::essential_goals({a.map, a.clearance_m, a.skeleton, a.places, input.visited}, params.goals);
  tell(Stage::kGoals);
  return a;
}

}  // namespace topo::pipeline

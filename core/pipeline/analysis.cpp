// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/analysis.hpp"

#include <algorithm>
#include <cmath>

#include "core/grid/distance.hpp"
#include "core/places/furniture.hpp"

namespace topo::pipeline {

ClearMap coarser(const grid::DenseMap& map, std::span<const float> clearance_m, int doublings) {
  // Of several states the most weighs: occupied over free, and free over unknown.
  using grid::CellState;
  static_assert(CellState::kUnknown < CellState::kFree && CellState::kFree < CellState::kOccupied);
  ClearMap out;
  out.map.resolution_m = std::ldexp(map.resolution_m, doublings);
  if (map.box.empty()) return out;
  const auto wide = [doublings](std::int32_t v) { return v >> doublings; };  // towards minus infinity
  out.map.box.min = {wide(map.box.min.x) - 1, wide(map.box.min.y) - 1};
  out.map.box.max = {wide(map.box.max.x) + 1, wide(map.box.max.y) + 1};
  const auto size = static_cast<std::size_t>(out.map.width()) * static_cast<std::size_t>(out.map.height());
  out.map.cells.assign(size, CellState::kUnknown);
  out.clearance_m.assign(size, 0.0F);
  std::size_t from = 0;
  for (std::int32_t y = map.box.min.y; y <= map.box.max.y; ++y) {
    const std::size_t row = out.map.index({out.map.box.min.x, wide(y)});
    for (std::int32_t x = map.box.min.x; x <= map.box.max.x; ++x, ++from) {
      const std::size_t to = row + static_cast<std::size_t>(wide(x) - out.map.box.min.x);
      out.map.cells[to] = std::max(out.map.cells[to], map.cells[from]);
      out.clearance_m[to] = std::max(out.clearance_m[to], clearance_m[from]);
    }
  }
  for (std::size_t i = 0; i < size; ++i)
    if (out.map.cells[i] != CellState::kFree) out.clearance_m[i] = 0.0F;
  return out;
}

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

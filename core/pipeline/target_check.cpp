// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/grid/nearest_reachable.hpp"
#include "core/pipeline/planning_step.hpp"

namespace topo::pipeline {

types::Status check_target(const TargetGround& ground, const PlannerParams& params,
                           const types::Vector2& target) {
  using types::Errc;
  if (!types::allows(params.area, target))
    return types::fail(Errc::kInvalidInput,
                       "the target is in an area that is kept out of, or outside of the one that is kept in");
  if (ground.area != params.area)
    return types::fail(
        Errc::kBusy,
        "an area changed just now, and the map is not analysed with it yet; try again in a moment");
  const analysis::Analysis& analysis = *ground.analysis;
  const grid::DenseMap& map = analysis.map;
  const grid::CellIndex cell = map.cell_at(target);
  switch (map.state(cell)) {
    case grid::CellState::kUnknown:
      return types::fail(Errc::kInvalidInput, "the target is in unknown space");
    case grid::CellState::kOccupied:
      return types::fail(Errc::kInvalidInput, "something stands at the target");
    case grid::CellState::kFree:
      break;
  }
  const std::vector<float> clearance_m = analysis::clearance_of(analysis);
  const grid::TravelField field =
      grid::travel_field(map, clearance_m, map.cell_at(ground.from), params.travel);
  if (!grid::nearest_to_stay_at(map, field, cell, params.route_map.target_beside_m))
    return types::fail(Errc::kInvalidInput, "no way that is wide enough for the robot leads to the target");
  return {};
}

}  // namespace topo::pipeline

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/goals/essential_goals.hpp"
#include "core/goals/goal.hpp"
#include "core/grid/dense_map.hpp"
#include "core/grid/distance.hpp"
#include "core/pipeline/map_snapshot.hpp"
#include "core/places/place_map.hpp"
#include "core/walls/compass.hpp"
#include "core/walls/wall_extraction.hpp"

namespace topo::pipeline {

struct AnalysisParams {
  walls::CompassParams compass;
  walls::WallParams walls;
  places::PlaceParams places;
  goals::GoalParams goals;
};

/// Everything the topometric analysis says of one map (paper sections II-A to II-E). A value.
struct Analysis {
  std::uint64_t revision = 0;
  grid::DenseMap map;
  std::vector<float> clearance_m;  ///< kOccupiedOrUnknown
  walls::Compass compass;
  std::vector<types::Segment> walls;
  places::Skeleton skeleton;  ///< of the map without furniture (core/places/furniture.hpp)
  places::PlaceMap places;
  goals::GoalSet goals;
};

enum class Stage : std::uint8_t { kCompass, kWalls, kFurniture, kSkeleton, kLabels, kReduction, kGoals };

/// Told after each stage, in the order of the enumeration: who measures brings the clock.
using StageWatch = std::function<void(Stage)>;

/// What one analysis leaves to the next, so that less is done again; what is found does not depend on it.
struct AnalysisMemory {
  grid::ClearanceUpdate without_furniture;
};

/// All stages on one snapshot. `map` is made of it (prepared_map.hpp), `clearance_m` is its distance map with
/// kOccupiedOrUnknown; `visited` are the corrected paths of all robots, in map.
Analysis analyse(const MapSnapshot& snapshot, grid::DenseMap map, std::vector<float> clearance_m,
                 std::span<const types::Vector2> visited, const AnalysisParams& params,
                 AnalysisMemory& memory, const StageWatch& done = {});

}  // namespace topo::pipeline

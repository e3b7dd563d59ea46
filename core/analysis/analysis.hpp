// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/compass/compass.hpp"
#include "core/goals/essential_goals.hpp"
#include "core/goals/goal.hpp"
#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/walls/wall_params.hpp"

namespace topo::analysis {

struct AnalysisParams {
  bool wall_store = true;  ///< false, an ablation: walls of what is occupied, as without a coronal scanner
  compass::CompassParams compass;
  walls::WallParams walls;
  places::PlaceParams places;
  goals::GoalParams goals;
};

/// Everything the topometric analysis says of one map (paper sections II-A to II-E). A value.
struct Analysis {
  std::uint64_t revision = 0;
  grid::DenseMap map;
  /// Of a coarse map, whose distances are not those between its own cells (coarse_map.hpp); else empty.
  std::vector<float> coarse_m;
  compass::Compass compass;
  std::vector<types::Segment> walls;
  places::Skeleton skeleton;  ///< of the map without furniture (core/places/segmentation/furniture.hpp)
  places::PlaceMap places;
  goals::GoalSet goals;
};

/// That by which the map was analysed, with kOccupiedOrUnknown.
std::vector<float> clearance_of(const Analysis& analysis);

enum class Stage : std::uint8_t { kCompass, kWalls, kFurniture, kSkeleton, kLabels, kReduction, kGoals };

/// Told after each stage, in the order of the enumeration: who measures brings the clock.
using StageWatch = std::function<void(Stage)>;

/// What is analysed: whoever analyses it needs no snapshot.
struct AnalysisInput {
  std::uint64_t revision = 0;
  grid::DenseMap map;                                ///< made of a snapshot (travel_map.hpp)
  std::span<const float> clearance_m;                ///< of the map, or of a finer one; borrowed for the call
  std::vector<types::Vector2> wall_points;           ///< of the wall store; none without a coronal scanner
  std::vector<std::vector<types::Vector2>> visited;  ///< corrected paths of all robots, in map
};

/// All stages on one map.
Analysis analyse(AnalysisInput input, const AnalysisParams& params, const StageWatch& done = {});

}  // namespace topo::analysis

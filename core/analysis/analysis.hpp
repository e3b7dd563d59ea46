// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/analysis/wings.hpp"
#include "core/compass/compass.hpp"
#include "core/goals/essential_goals.hpp"
#include "core/goals/goal.hpp"
#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/walls/wall_params.hpp"

namespace topo::analysis {

struct AnalysisParams {
  bool wall_store = true;  ///< false, an ablation: walls from occupied cells, as without a coronal scanner
  compass::CompassParams compass;
  walls::WallParams walls;
  WingParams wings;
  places::SkeletonParams skeleton;
  places::PlaceParams places;
  goals::GoalParams goals;
};

/// Result of the topometric analysis of one map (paper sections II-A to II-E). A value.
struct Analysis {
  std::uint64_t revision = 0;
  grid::DenseMap map;
  /// Distances of a coarse map, which are not those between its own cells (coarse_map.hpp); else empty.
  std::vector<float> coarse_m;
  compass::Compass compass;
  std::vector<double> wings_rad;          ///< directions of wings that are skew to the compass
  std::vector<types::Segment> walls;      ///< along and across the compass, then those of the wings
  std::vector<types::Segment> continued;  ///< those walls, where they have not been seen
  places::Skeleton skeleton;  ///< of the map without furniture (core/places/segmentation/furniture.hpp)
  places::PlaceMap places;
  goals::GoalSet goals;
};

/// The clearance used for the analysis, with kOccupiedOrUnknown.
std::vector<float> clearance_of(const Analysis& analysis);

enum class Stage : std::uint8_t { kCompass, kWalls, kFurniture, kSkeleton, kLabels, kReduction, kGoals };

/// Called after each stage, in the order of the enumeration. A caller that measures times supplies the clock.
using StageWatch = std::function<void(Stage)>;

/// Input of an analysis, which needs no snapshot.
struct AnalysisInput {
  std::uint64_t revision = 0;
  grid::DenseMap map;                       ///< made from a snapshot (travel_map.hpp)
  std::span<const float> clearance_m;       ///< of this map, or of a finer one; borrowed for the call
  std::vector<types::Vector2> wall_points;  ///< of the wall store; empty without a coronal scanner
  std::vector<std::vector<types::Vector2>> visited;  ///< corrected paths of all robots, in map
};

/// Runs all stages on one map.
Analysis analyse(AnalysisInput input, const AnalysisParams& params, const StageWatch& done = {});

}  // namespace topo::analysis

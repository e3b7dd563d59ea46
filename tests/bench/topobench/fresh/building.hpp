// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/types/result.hpp"
#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/raster.hpp"

namespace topo::bench::fresh {

inline constexpr double kAreaMin_m2 = 300.0, kAreaMax_m2 = 3000.0;  ///< of the free floor

/// What a robot gets through without doubt: a door of kDoorMin_m, as a disc.
inline constexpr double kRobotRadius_m = 0.3;

struct Building {
  FloorPlan plan;
  sim::Raster free;  ///< 1 where nothing stands; all of it is connected
  sim::Se2 start;    ///< in a corridor or a hall, along it, with room for a team
};

/// The building of a seed: the same on every machine. What is drawn and turns out too small, too large or
/// with a room that a robot does not get into is drawn again. An error when that happens a hundred times.
types::Result<Building> draw_building(std::uint64_t seed);

}  // namespace topo::bench::fresh

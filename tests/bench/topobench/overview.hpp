// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tests/sim/picture.hpp"

namespace topo::bench {

/// What a run left in the building. All in the building's frame; borrowed for the call.
struct OverviewParts {
  const sim::Raster& visible;                         ///< the area
  const sim::Raster& covered;                         ///< what of it is known as free
  std::span<const sim::Se2> path;                     ///< true, from the start on
  std::span<const types::Vector2> goals;              ///< in order
  std::span<const std::vector<sim::Se2>> mates = {};  ///< paths of other robots
};

/// True walls, the area (green: covered, red: not), the path, the goals joined in order, the start.
sim::Picture overview(const sim::World& world, const OverviewParts& parts);

}  // namespace topo::bench

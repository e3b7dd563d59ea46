// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/grid/wavefront.hpp"

namespace topo::travel {

/// The narrowest place of the widest way over free cells to a part of the map that a robot does not reach.
struct NarrowPassage {
  types::Vector2 p_map{0.0, 0.0};
  double width_m = 0.0;  ///< twice the clearance there
};

/// For each of `ends`, indices into the map, that the field does not reach: the passage that keeps the robot
/// out; nothing for ends that it reaches, and where no free cells lead. Each passage once. `clearance_m`: as
/// map.cells. Cost: one pass over the map, and a search of the free cells that are not reached.
std::vector<NarrowPassage> narrow_passages(const grid::DenseMap& map, std::span<const float> clearance_m,
                                           const grid::TravelField& field,
                                           std::span<const std::uint32_t> ends);

}  // namespace topo::travel

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// The labels on both sides of a stretch of wall; equal at an opening.
struct WallBetween {
  std::uint32_t a = 0, b = 0;
  std::uint32_t steps = 0;
  friend bool operator==(const WallBetween&, const WallBetween&) = default;
};

/// Length of a wall of this number of steps, added one by one, so that it is bit-identical however the steps
/// were counted.
float wall_length_m(std::uint32_t steps, double step_m);

/// The labels on both sides of walls, step by step along them, in the order of the walls; a pair of labels
/// may occur repeatedly. Walls may have any direction.
std::vector<WallBetween> wall_sides(const grid::DenseMap& map, std::span<const std::uint32_t> labels,
                                    std::span<const types::Segment> walls, const WallSideParams& params);

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tests/sim/raster.hpp"

namespace topo::bench {

/// How often robots drive through the same narrow parts of a building.
struct Crossings {
  std::size_t squares = 0;     ///< narrow squares that any robot was in
  std::size_t over_twice = 0;  ///< of these, passed more than twice, by all robots together
};

/// Squares of 2 m in which a way leads through less than 3 m of room count as narrow: corridors, doors. A
/// square is passed when a robot comes into it; one that was left for no more than two other squares counts
/// as not left. `free`: of the building. `ways`: of each robot, poses at most a metre apart.
Crossings count_crossings(const sim::Raster& free, std::span<const std::vector<sim::Se2>> ways);

}  // namespace topo::bench

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench::fresh {

/// How full the rooms of one building are.
struct Furnishing {
  double furnished = 0.7;  ///< share of the rooms that have anything in them
  double density = 1.0;    ///< of pieces, times the usual
  bool pilasters = false;  ///< along the walls of rooms
  bool legs = false;       ///< tables are seen as their legs, not as boxes
};

Furnishing furnishing_of(sim::Random& random);

/// Furniture for every space of a wing that has its doors: nothing stands before a door. Whether a robot gets
/// everywhere is checked on the drawn floor (building.hpp).
void furnish(Wing& wing, const Furnishing& furnishing, sim::Random& random);

}  // namespace topo::bench::fresh

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench::fresh {

/// Where a corridor (or a hall) of a wing ends at the wing's outer wall.
struct WayOut {
  sim::Vector2 at{0.0, 0.0};      ///< middle of the end, in the wing's frame
  sim::Vector2 normal{1.0, 0.0};  ///< out of the wing
  double width_m = 0.0;
};
std::vector<WayOut> ways_out(const Wing& wing);

/// Puts a further wing beside those that are there, in line with one of their ways out or skew to it, and
/// joins them by a link. False when there is no room for it: then nothing has changed.
bool attach(FloorPlan& plan, Wing wing, sim::Random& random);

/// Do two convex outlines have points in common? (Separating axes.)
bool convex_overlap(const sim::Polygon& a, const sim::Polygon& b);

}  // namespace topo::bench::fresh

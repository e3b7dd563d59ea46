// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench::fresh {

inline constexpr double kDoorMin_m = 0.7, kDoorMax_m = 2.0;

/// A straight piece of wall between two spaces that a door can be in.
struct SharedWall {
  std::size_t a = 0, b = 0;         ///< a on the left of b or below it
  bool along_x = true;              ///< one goes through in the direction of x
  double wall_at_m = 0.0;           ///< x (or y) where the wall begins
  double from_m = 0.0, to_m = 0.0;  ///< y (or x) of what both sides have free
  [[nodiscard]] double length_m() const { return to_m - from_m; }
};

/// Of all pairs of spaces that are not closed, those that a robot fits through.
std::vector<SharedWall> shared_walls(const Wing& wing);

/// How doors are drawn in one building.
struct DoorRules {
  double narrow = 0.1;       ///< share of doors under 0.8 m
  double connecting = 0.12;  ///< share of the walls between rooms with a door
  double second = 0.25;      ///< share of rooms at a second corridor with a door there too
  double fire_door = 0.15;   ///< share of the crossings of corridors with a door
  double lobby = 0.2;        ///< share of halls that are open to a corridor along all of their wall
  double alcove = 0.05;      ///< the same of rooms
};

/// Puts doors into a wing: corridors are open to each other or have a wide door between them; a room has a
/// door to a corridor, if it touches one; and as many more as connect everything. Spaces that cannot be
/// connected become closed.
void add_doors(Wing& wing, const DoorRules& rules, sim::Random& random);

/// Leaves of a share of the doors, wide open into a room: thin pieces beside the gap.
void add_leaves(Wing& wing, double share, sim::Random& random);

}  // namespace topo::bench::fresh

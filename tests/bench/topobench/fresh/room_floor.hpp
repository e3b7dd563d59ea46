// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tests/bench/topobench/fresh/floor_plan.hpp"
#include "tests/sim/random.hpp"

namespace topo::bench::fresh {

/// The floor of one space while it is furnished.
class RoomFloor {
 public:
  RoomFloor(Wing& wing, std::size_t space);

  [[nodiscard]] const Box& box() const { return box_; }
  /// Stands there, unless it is before a door, in a wall, or upon something. Pieces may touch.
  bool put(const Box& piece);
  bool put(const sim::Polygon& outline);
  /// A thing of up to 0.5 m across: a round one, or five feet.
  void put_chair(const sim::Vector2& at, sim::Random& random);
  /// A table as a box, or as four legs.
  bool put_table(const Box& table, bool legs);

 private:
  [[nodiscard]] bool is_free(const Box& piece) const;

  Wing& wing_;
  std::size_t space_;
  Box box_;
  std::vector<Box> kept_free_, taken_;
};

/// A box at a wall of the room: `along_m` from its corner, `length_m` along the wall, `depth_m` into the
/// room. Walls 0 to 3: below, right, above, left.
Box at_wall(const Box& room, int wall, double along_m, double length_m, double depth_m);
double wall_length_m(const Box& room, int wall);

}  // namespace topo::bench::fresh

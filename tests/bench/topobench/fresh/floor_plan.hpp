// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/sim/shapes.hpp"

// What a drawn building is made of, before it becomes an image. All lengths in metres, in whole cells of
// kCell_m where a wing is not turned.
namespace topo::bench::fresh {

/// Resolution of the images, as most of the public plans have it.
inline constexpr double kCell_m = 0.05;

/// A rectangle along the axes of its wing.
struct Box {
  double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;

  [[nodiscard]] double width() const { return x1 - x0; }
  [[nodiscard]] double height() const { return y1 - y0; }
  [[nodiscard]] double area_m2() const { return width() * height(); }
  [[nodiscard]] bool contains(const sim::Vector2& p) const {
    return p.x() >= x0 && p.x() <= x1 && p.y() >= y0 && p.y() <= y1;
  }
  friend bool operator==(const Box&, const Box&) = default;
};

/// Enlarged by `by_m` on every side.
Box grown(const Box& box, double by_m);
bool overlap(const Box& a, const Box& b);
sim::Polygon corners(const Box& box);

enum class Use : std::uint8_t {
  kCorridor,
  kRoom,
  kHall,
  kClosed,  ///< a shaft, or a room that is locked: solid
};

/// A part of a wing's floor. The boxes of a wing lie side by side without a gap; the wall between two of them
/// belongs to the one on the right or above, on its left or lower side.
struct Space {
  Box box;
  Use use = Use::kRoom;
};

/// Free space of a box, without its walls.
Box floor_of(const Space& space, double wall_m);

/// A gap in the wall between two spaces of one wing.
struct Door {
  std::size_t a = 0, b = 0;  ///< the spaces
  Box gap;                   ///< the piece of wall that is missing
  bool along_x = true;       ///< one goes through in the direction of x
  [[nodiscard]] double width_m() const { return along_x ? gap.height() : gap.width(); }
};

/// A thing that stands on the floor, in the wing's frame.
struct Piece {
  sim::Polygon outline;
  std::size_t space = 0;  ///< where it stands
};

struct Wing {
  sim::Se2 T_building_wing;
  double wall_m = 0.15;
  Box outline;
  std::vector<Space> spaces;
  std::vector<Door> doors;
  std::vector<Piece> pieces;
};

/// A whole floor. Links are the ways from wing to wing, in the building's frame.
struct FloorPlan {
  std::vector<Wing> wings;
  std::vector<sim::Polygon> links;
};

}  // namespace topo::bench::fresh

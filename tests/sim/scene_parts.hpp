// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/sim/shapes.hpp"

namespace topo::sim {

/// A gap in a wall, or an alcove beside it, around a position along the wall.
struct WallFeature {
  enum class Kind { kOpening, kAlcove };
  Kind kind = Kind::kOpening;
  double at_m = 0.0;  ///< position of the middle along the wall, from its first point
  double width_m = 0.9;
  double lintel_m = 0.0;  ///< opening: the wall continues above this height; 0: open to the ceiling
  double depth_m = 0.3;   ///< alcove: lateral displacement of the wall
  bool left = true;       ///< alcove: to the left of the wall's direction
};

/// Furniture along a line, on the left of its direction, as boxes drawn from a seed.
struct ClutterRow {
  Vector2 from{0.0, 0.0};
  Vector2 to{0.0, 0.0};
  double fraction = 0.6;  ///< occupied share of the line's length
  std::uint64_t seed = 1;
  double length_min_m = 0.4, length_max_m = 1.4;
  double depth_min_m = 0.25, depth_max_m = 0.6;
  double height_min_m = 0.4, height_max_m = 1.8;
};
/// The same along one side of a wall: on every straight part, clear of corners, openings and alcoves.
struct WallClutter {
  bool left = true;
  double margin_m = 0.35;  ///< free distance to a corner, an opening or an alcove
  ClutterRow row;          ///< from and to are not used
};

struct DrawnWall {
  std::vector<Vector2> points;
  double thickness_m = 0.12;
  double z_min_m = 0.0;
  double z_max_m = 2.5;
  std::vector<WallFeature> features;
  std::vector<WallClutter> clutter;
};

/// Adds the prisms of a wall with its openings, alcoves and clutter. Returns a text when a feature does not
/// fit: it must lie within one straight part and must not overlap another.
std::string build_wall(DrawnWall wall, std::vector<Prism>& out);

/// Adds the boxes of one row.
void build_clutter(const ClutterRow& row, std::vector<Prism>& out);

}  // namespace topo::sim

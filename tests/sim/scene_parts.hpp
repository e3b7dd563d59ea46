// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/sim/shapes.hpp"

namespace topo::sim {

/// A gap in a wall, or a niche beside it, around a place along it.
struct WallFeature {
  enum class Kind { kOpening, kAlcove };
  Kind kind = Kind::kOpening;
  double at_m = 0.0;  ///< of its middle, along the wall from its first point
  double width_m = 0.9;
  double lintel_m = 0.0;  ///< opening: wall again from here up; 0: open to the ceiling
  double depth_m = 0.3;   ///< alcove: how far the wall steps aside
  bool left = true;       ///< alcove: to the left of the wall's direction
};

/// Furniture along a line, on the left of its direction, as boxes drawn from a seed.
struct ClutterRow {
  Vector2 from{0.0, 0.0};
  Vector2 to{0.0, 0.0};
  double fraction = 0.6;  ///< of the line's length that is taken
  std::uint64_t seed = 1;
  double length_min_m = 0.4, length_max_m = 1.4;
  double depth_min_m = 0.25, depth_max_m = 0.6;
  double height_min_m = 0.4, height_max_m = 1.8;
};
/// The same along one side of a wall: on every straight part, clear of corners, openings and alcoves.
struct WallClutter {
  bool left = true;
  double margin_m = 0.35;  ///< kept free beside a corner, an opening or an alcove
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

/// Prisms of a wall with its openings, alcoves and clutter; a text when a feature does not fit: it must lie
/// within one straight part and not overlap another.
std::string build_wall(DrawnWall wall, std::vector<Prism>& out);

/// The boxes of one row.
void build_clutter(const ClutterRow& row, std::vector<Prism>& out);

}  // namespace topo::sim

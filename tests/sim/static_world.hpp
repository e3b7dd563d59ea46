// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tests/sim/edge_index.hpp"
#include "tests/sim/raster.hpp"
#include "tests/sim/world.hpp"

namespace topo::sim {

/// Lower and upper limit of the space of a robot with its scanners, for masks.
inline constexpr double kRobotSpaceLow_m = 0.03;
inline constexpr double kRobotSpaceHigh_m = 0.50;

/// The immovable part of a building.
struct StaticWorld {
  std::string name;
  types::Rectangle extents;
  double ceiling_m = 2.5;
  std::vector<Se2> starts;
  std::vector<Prism> prisms;           ///< drawn walls and objects; furniture of an image
  std::vector<Polygon> wall_outlines;  ///< borders between free and solid of an image, at full height
  std::vector<types::Segment> glass;
  std::vector<Edge> glass_edges;
  Raster walls;      ///< 1 = solid at every height (image); all 0 for a drawn scene
  Raster structure;  ///< 1 = free for a robot
  EdgeIndex index;
};

/// Fills extents, index and structure from outlines, prisms, glass and `walls`.
void finish(StaticWorld& world);

/// 1 where there is no wall, prism or glass between the heights.
Raster compute_free_mask(const StaticWorld& world, double z_min_m, double z_max_m);

/// Loads a building from a map_server YAML.
types::Result<StaticWorld> load_image_world(const std::filesystem::path& yaml);

/// Parses the text of a drawn scene.
types::Result<StaticWorld> parse_scene(const std::string& text, const std::string& name);

}  // namespace topo::sim

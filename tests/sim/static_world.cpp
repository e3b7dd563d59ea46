// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/sim/static_world.hpp"

#include <algorithm>
#include <cmath>

namespace topo::sim {

namespace {

void add_outline(const Polygon& outline, double z_min_m, double z_max_m, std::vector<Edge>& edges) {
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    edges.push_back({outline[j], outline[i], z_min_m, z_max_m, 0.0, Surface::kWall});
  }
}

void clear_polygon(const Polygon& outline, Raster& mask) {
  const types::Rectangle box = bounds(outline);
  const int x1 = mask.column(box.max.x());
  const int y1 = mask.row(box.max.y());
  for (int y = mask.row(box.min.y()); y <= y1; ++y) {
    for (int x = mask.column(box.min.x()); x <= x1; ++x) {
      if (mask.at(x, y) != 0 && contains(outline, mask.center(x, y))) mask.set(x, y, 0);
    }
  }
}

void clear_line(const Vector2& a, const Vector2& b, Raster& mask) {
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (0.5 * mask.resolution_m))));
  for (int i = 0; i <= steps; ++i) {
    const Vector2 p = a + (b - a) * (static_cast<double>(i) / steps);
    mask.set(mask.column(p.x()), mask.row(p.y()), 0);
  }
}

bool overlaps(double a_min, double a_max, double b_min, double b_max) {
  return a_min < b_max && b_min < a_max;
}

}  // namespace

Raster compute_free_mask(const StaticWorld& world, double z_min_m, double z_max_m) {
  Raster mask = world.walls;
  for (std::uint8_t& cell : mask.cells) cell = cell == 0 ? 1 : 0;
  for (const Prism& prism : world.prisms) {
    if (!overlaps(prism.z_min_m, prism.z_max_m, z_min_m, z_max_m)) continue;
    clear_polygon(prism.outline, mask);
    for (std::size_t i = 0, j = prism.outline.size() - 1; i < prism.outline.size(); j = i++) {
      clear_line(prism.outline[j], prism.outline[i], mask);  // thin objects must not lie between cell centres
    }
  }
  for (const Edge& pane : world.glass_edges) {
    if (overlaps(pane.z_min_m, pane.z_max_m, z_min_m, z_max_m)) clear_line(pane.a, pane.b, mask);
  }
  return mask;
}

void finish(StaticWorld& world) {
  std::vector<Edge> edges = world.glass_edges;
  for (const Polygon& outline : world.wall_outlines) add_outline(outline, 0.0, world.ceiling_m, edges);
  for (const Prism& prism : world.prisms) add_outline(prism.outline, prism.z_min_m, prism.z_max_m, edges);
  world.index = EdgeIndex(std::move(edges), world.prisms);
  world.extents = world.index.bounds();
  if (world.walls.cells.empty()) {
    constexpr double kResolution_m = 0.05;
    const Vector2 size = world.extents.max - world.extents.min;
    world.walls =
        Raster(kResolution_m, world.extents.min, static_cast<int>(std::ceil(size.x() / kResolution_m)),
               static_cast<int>(std::ceil(size.y() / kResolution_m)));
  }
  world.structure = compute_free_mask(world, kRobotSpaceLow_m, kRobotSpaceHigh_m);
}

}  // namespace topo::sim

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/analysis.hpp"
namespace topo::walls {
std::vector<types::Vector2> __attribute__((weak)) wall_points(const WallStore&) { return {}; }
std::vector<types::Vector2> __attribute__((weak)) occupied_points(const grid::DenseMap&) { return {}; }
Compass __attribute__((weak)) entropy_compass(std::span<const types::Vector2>, const CompassParams&) {
  return {};
}
std::vector<types::Segment> __attribute__((weak))
extract_walls(std::span<const types::Vector2>, double, const WallParams&) {
  return {};
}
}  // namespace topo::walls

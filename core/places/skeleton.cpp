// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton.hpp"

#include <cassert>

#include "core/places/skeleton_graph.hpp"
#include "core/places/thinning.hpp"

namespace topo::places {
namespace {

/// How far the disc around the edge's end sticks out beyond the one around its junction: as the crow flies,
/// because a way over cells is up to 8 % longer; along the edge when that turns.
double protrusion_m(const grid::DenseMap& map, const Skeleton& skeleton, const SkeletonEdge& edge,
                    std::uint32_t end) {
  const SkeletonNode& tip = skeleton.nodes[end];
  const SkeletonNode& junction = skeleton.nodes[edge.a == end ? edge.b : edge.a];
  const double straight_m = (map.centre_of(tip.cell) - map.centre_of(junction.cell)).norm();
  const auto length_m = static_cast<double>(edge.length_m);
  const double away_m = length_m < 1.2 * straight_m + 2.0 * map.resolution_m ? straight_m : length_m;
  return away_m + static_cast<double>(tip.clearance_m - junction.clearance_m);
}

/// Unevenness of walls makes short side branches, which say nothing of the disposition of free space. True
/// when one was taken away.
bool drop_spurs(const grid::DenseMap& map, const Skeleton& skeleton, double spur_m, Thinning& thinning) {
  bool dropped = false;
  const auto offsets = neighbour_offsets(map);
  const auto drop = [&](std::span<const std::uint32_t> cells) {
    for (const std::uint32_t i : cells) thinning.take_away(i, offsets, [](std::uint32_t) {});
  };
  for (const SkeletonEdge& edge : skeleton.edges) {
    const bool a_ends = skeleton.nodes[edge.a].degree == 1, b_ends = skeleton.nodes[edge.b].degree == 1;
    if (a_ends == b_ends) continue;  // between junctions, or all there is of a component
    const std::uint32_t end = a_ends ? edge.a : edge.b;
    if (protrusion_m(map, skeleton, edge, end) > spur_m) continue;
    drop(skeleton.cells_of(edge));
    drop(skeleton.cells_of(skeleton.nodes[end]));
    dropped = true;
  }
  if (dropped) std::erase_if(thinning.remain, [&](std::uint32_t i) { return thinning.marks[i] == 0; });
  return dropped;
}

}  // namespace

Skeleton skeletonise(const grid::DenseMap& map, std::span<const float> clearance_m, const Erosion& erosion,
                     const SkeletonParams& params) {
  assert(clearance_m.size() == map.cells.size());
  Skeleton skeleton;
  Thinning thinning = thin_to_ridge(map, erosion);
  GraphTracer tracer(map, clearance_m);
  // Without its spurs a junction may be none any more, and what it was an end of a spur itself.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    thin_to_lines(map, thinning);
    tracer.trace(thinning, skeleton);
    if (round + 1 == kRounds || !drop_spurs(map, skeleton, params.spur_m, thinning)) break;
  }
  skeleton.on.resize(map.cells.size(), false);
  for (const std::uint32_t i : thinning.remain) skeleton.on[i] = true;
  return skeleton;
}

Skeleton skeletonise(const grid::DenseMap& map, std::span<const float> clearance_m,
                     const SkeletonParams& params) {
  return skeletonise(map, clearance_m, erode(map, clearance_m), params);
}

}  // namespace topo::places

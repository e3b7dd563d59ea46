// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/skeleton.hpp"

#include <cassert>

#include "core/places/skeleton/skeleton_graph.hpp"
#include "core/places/skeleton/spurs.hpp"
#include "core/places/skeleton/thinning.hpp"

namespace topo::places {

Skeleton skeletonise(const grid::DenseMap& map, std::span<const float> clearance_m, const Erosion& erosion,
                     const SkeletonParams& params) {
  assert(clearance_m.size() == map.cells.size());
  Skeleton skeleton;
  Thinning thinning = thin_to_ridge(map, erosion);
  thin_to_lines(map, thinning);
  Spurs spurs(map, clearance_m, params);
  for (int round = 0; round < params.rounds_max && spurs.drop(thinning); ++round)
    thin_to_lines(map, thinning);
  GraphTracer tracer(map, clearance_m);
  tracer.trace(thinning, skeleton);
  tracer.find_narrowest(skeleton);
  skeleton.on.resize(map.cells.size(), false);
  for (const std::uint32_t i : thinning.remain) skeleton.on[i] = true;
  return skeleton;
}

Skeleton skeletonise(const grid::DenseMap& map, std::span<const float> clearance_m,
                     const SkeletonParams& params) {
  return skeletonise(map, clearance_m, erode(map, clearance_m), params);
}

}  // namespace topo::places

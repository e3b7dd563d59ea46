// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/topobench/slam/canonical_share.hpp"

#include <algorithm>

#include "core/grid/occupancy_grid.hpp"
#include "core/slam/canonical_map.hpp"

namespace topo::bench {

double unlike_canonical_share(const slam::Mapper& mapper, const grid::OccupancyGrid& grid) {
  if (mapper.keyframes().empty()) return 0.0;
  slam::KeyframeSet keyframes;
  for (const slam::KeyframePtr& keyframe : mapper.keyframes()) keyframes.insert(keyframe);
  slam::RelationSet relations;
  for (const slam::FoundRelation& found : mapper.found_since(0)) relations.insert(found.key, found.relation);
  const slam::CanonicalMap canonical = slam::canonical_map(
      keyframes, relations, mapper.keyframes().front()->id, mapper.params().graph, mapper.params().grid);
  std::size_t known = 0;
  canonical.map->grid().for_each_known([&](grid::CellIndex, grid::CellState) { ++known; });
  const std::size_t unlike = grid::differing_cells(grid, canonical.map->grid());
  return static_cast<double>(unlike) / static_cast<double>(std::max<std::size_t>(1, known));
}

}  // namespace topo::bench

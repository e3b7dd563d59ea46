// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/skeleton/erosion.hpp"

namespace topo::places {

/// Which side branches of the axis have no meaning. No source is recorded for the values.
struct SkeletonParams {
  double spur_m = 0.30;  ///< an end is dropped when its disc protrudes no more than this from its junction's
  int rounds_max = 3;    ///< of dropping: without its spurs a junction may be the end of another spur
  double straight_ratio = 1.2;  ///< a branch up to this multiple of the straight distance,
  double straight_cells = 2.0;  ///< plus this, is straight: a path over cells is up to 8 % longer
};

/// A junction or an end of the skeleton.
struct SkeletonNode {
  grid::CellIndex cell;  ///< on the axis: the node's cell with the largest clearance
  float clearance_m = 0.0F;
  int degree = 0;                ///< ends of edges here; a loop counts twice
  std::uint32_t first_cell = 0;  ///< in Skeleton::axis: a junction may have several cells
  std::uint32_t cell_count = 0;
};

struct SkeletonEdge {
  std::uint32_t a = 0;  ///< nodes; may be the same for a loop
  std::uint32_t b = 0;
  float length_m = 0.0F;
  float clearance_min_m = 0.0F;  ///< smallest, including the ends
  std::uint32_t first_cell = 0;  ///< in Skeleton::axis, from a to b, without the nodes' own cells
  std::uint32_t cell_count = 0;
};

/// One-pixel medial axis of the free space, with the same number of components and holes, and its graph
/// (paper section II-C). Free cells are connected over eight neighbours, the cells that bound them over four.
struct Skeleton {
  std::vector<bool> on;  ///< the axis; as long as map.cells
  std::vector<SkeletonNode> nodes;
  std::vector<SkeletonEdge> edges;
  std::vector<std::uint32_t> axis;  ///< every cell of the axis once, as an index into the map: see first_cell

  [[nodiscard]] std::span<const std::uint32_t> cells_of(const SkeletonNode& node) const {
    return std::span(axis).subspan(node.first_cell, node.cell_count);
  }
  [[nodiscard]] std::span<const std::uint32_t> cells_of(const SkeletonEdge& edge) const {
    return std::span(axis).subspan(edge.first_cell, edge.cell_count);
  }
};

/// `clearance_m`: grid::clearance_m of the map with kOccupiedOrUnknown; `erosion` of both. Linear in the
/// cells.
Skeleton skeletonise(const grid::DenseMap& map, std::span<const float> clearance_m, const Erosion& erosion,
                     const SkeletonParams& params = {});

/// The same; computes the erosion.
Skeleton skeletonise(const grid::DenseMap& map, std::span<const float> clearance_m,
                     const SkeletonParams& params = {});

}  // namespace topo::places

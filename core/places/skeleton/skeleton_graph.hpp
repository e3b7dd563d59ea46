// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/places/skeleton/cell_numbers.hpp"
#include "core/places/skeleton/skeleton.hpp"
#include "core/places/skeleton/thinning.hpp"

namespace topo::places {

/// Builds nodes, edges and axis of a skeleton from its cells.
class GraphTracer {
 public:
  GraphTracer(const grid::DenseMap& map, std::span<const float> clearance_m)
      : map_(map), clearance_m_(clearance_m), offsets_(neighbour_offsets(map)), node_of_(map.cells.size()) {}

  /// Fills in nodes, edges and axis of an empty skeleton, and marks their cells in `thinning`, which must
  /// have no such marks. Neither uses `skeleton.on` nor sets the clearance of edges.
  void trace(Thinning& thinning, Skeleton& skeleton);
  /// Sets the smallest clearance of the edges of the skeleton traced last. One loop covers the whole axis,
  /// because its cells are scattered over the map.
  void find_narrowest(Skeleton& skeleton) const;

 private:
  [[nodiscard]] int count_around(std::uint32_t i) const;
  [[nodiscard]] bool is_taken(std::uint32_t i) const {
    return (thinning_->marks[i] & (Thinning::kNode | Thinning::kEdge)) != 0;
  }
  void add_node(std::uint32_t seed, bool whole_junction);
  void add_edges_of(std::uint32_t node);
  void add_edge(std::uint32_t node, std::uint32_t from, std::size_t direction);
  void add_rings();
  [[nodiscard]] std::uint32_t neighbour(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }

  const grid::DenseMap& map_;
  std::span<const float> clearance_m_;
  std::array<std::ptrdiff_t, 8> offsets_;
  /// For each edge, the cells of its two nodes at which it begins and ends.
  std::vector<std::array<std::uint32_t, 2>> ends_;
  CellNumbers node_of_;  ///< node + 1 of cells marked as nodes; stale for other cells
  Thinning* thinning_ = nullptr;
  Skeleton* out_ = nullptr;
};

}  // namespace topo::places

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

/// Makes nodes, edges and axis of a skeleton from its cells.
class GraphTracer {
 public:
  GraphTracer(const grid::DenseMap& map, std::span<const float> clearance_m)
      : map_(map), clearance_m_(clearance_m), offsets_(neighbour_offsets(map)), node_of_(map.cells.size()) {}

  /// Fills in nodes, edges and axis of a skeleton without any, and marks in `thinning`, where nothing is
  /// marked as theirs yet, what belongs to them. `skeleton.on` is not used, and how clear edges are is not
  /// looked at.
  void trace(Thinning& thinning, Skeleton& skeleton);
  /// That of the edges of the skeleton traced last: over all of an axis at once, because its cells lie all
  /// over the map.
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
  /// Of each edge the nodes' cells that it leads from and to.
  std::vector<std::array<std::uint32_t, 2>> ends_;
  CellNumbers node_of_;  ///< node + 1 of the cells that are marked as nodes; of others some earlier one
  Thinning* thinning_ = nullptr;
  Skeleton* out_ = nullptr;
};

}  // namespace topo::places

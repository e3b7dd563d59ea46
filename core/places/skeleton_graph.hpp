// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/places/cell_numbers.hpp"
#include "core/places/skeleton.hpp"
#include "core/places/thinning.hpp"

namespace topo::places {

/// Makes nodes, edges and axis of a skeleton from its cells. One scratch serves several runs.
class GraphTracer {
 public:
  GraphTracer(const grid::DenseMap& map, std::span<const float> clearance_m)
      : map_(map), clearance_m_(clearance_m), offsets_(neighbour_offsets(map)), node_of_(map.cells.size()) {}

  /// Replaces nodes, edges and axis, and marks in `thinning` what belongs to them. `skeleton.on` is not used.
  void trace(Thinning& thinning, Skeleton& skeleton);

 private:
  [[nodiscard]] int count_around(std::uint32_t i) const;
  [[nodiscard]] bool is_taken(std::uint32_t i) const {
    return (thinning_->marks[i] & (Thinning::kNode | Thinning::kEdge)) != 0;
  }
  void add_node(std::uint32_t seed, bool whole_junction);
  void add_edges_of(std::uint32_t node);
  void add_edge(std::uint32_t node, std::uint32_t from, std::size_t direction);
  void add_rings();
  [[nodiscard]] float step_m(std::size_t direction) const;
  [[nodiscard]] std::uint32_t neighbour(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }

  const grid::DenseMap& map_;
  std::span<const float> clearance_m_;
  std::array<std::ptrdiff_t, 8> offsets_;
  CellNumbers node_of_;  ///< node + 1 of the cells that are marked as nodes; of others some earlier one
  Thinning* thinning_ = nullptr;
  Skeleton* out_ = nullptr;
};

}  // namespace topo::places

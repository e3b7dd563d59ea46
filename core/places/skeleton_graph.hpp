// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/places/skeleton.hpp"
#include "core/places/thinning.hpp"

namespace topo::places {

/// Makes nodes, edges and axis of a skeleton from its cells. One scratch array serves several runs.
class GraphTracer {
 public:
  GraphTracer(const grid::DenseMap& map, std::span<const float> clearance_m)
      : map_(map), clearance_m_(clearance_m), offsets_(neighbour_offsets(map)), owner_(map.cells.size(), 0) {}

  /// Replaces nodes, edges and axis. `skeleton.on` is not used.
  void trace(const Thinning& thinning, Skeleton& skeleton);

 private:
  static constexpr std::uint32_t kNobody = 0;
  static constexpr std::uint32_t kEdge = UINT32_MAX;

  [[nodiscard]] int count_around(std::uint32_t i) const;
  void add_node(std::uint32_t seed, bool whole_junction);
  void add_edges_of(std::uint32_t node);
  void add_edge(std::uint32_t node, std::uint32_t from, std::uint32_t first);
  void add_rings(const Thinning& thinning);
  [[nodiscard]] float step_m(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::uint32_t neighbour(std::uint32_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets_[k]);
  }

  const grid::DenseMap& map_;
  std::span<const float> clearance_m_;
  std::array<std::ptrdiff_t, 8> offsets_;
  std::vector<std::uint32_t> owner_;  ///< of cells on the axis: node + 1, or kEdge
  const std::uint8_t* marks_ = nullptr;
  Skeleton* out_ = nullptr;
};

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/elimination.hpp"
#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// True when chains of edges connect all nodes; those in `fixed`, whose poses are known, count as connected.
/// Edges refer to nodes below `nodes`.
bool is_connected(std::size_t nodes, std::span<const Edge> edges, std::span<const std::size_t> fixed = {});

/// The blocks of the normal equations that each edge of a graph adds to. All nodes except the fixed ones are
/// variables, in the order of the nodes.
class GraphPattern {
 public:
  GraphPattern(std::size_t nodes, std::span<const Edge> edges, std::span<const std::size_t> fixed);
  GraphPattern(std::size_t nodes, std::span<const Edge> edges, std::size_t fixed)
      : GraphPattern(nodes, edges, std::span<const std::size_t>(&fixed, 1)) {}

  struct EdgePlaces {
    std::size_t from_variable = 0, to_variable = 0;
    Elimination::Place from, to, between;   ///< `between`: row `from`, column `to`
    bool has_from = false, has_to = false;  ///< false: that end is a fixed node
  };

  [[nodiscard]] const Elimination& elimination() const { return elimination_; }
  [[nodiscard]] const std::vector<EdgePlaces>& links() const { return places_; }
  [[nodiscard]] std::size_t node(std::size_t variable) const { return node_of_[variable]; }

 private:
  static constexpr std::size_t kFixed = static_cast<std::size_t>(-1);

  [[nodiscard]] std::vector<Elimination::Link> variable_links(std::span<const Edge> edges) const;

  std::vector<std::size_t> node_of_;      ///< of each variable
  std::vector<std::size_t> variable_of_;  ///< of each node; kFixed for those that are none
  Elimination elimination_;
  std::vector<EdgePlaces> places_;
};

}  // namespace topo::slam

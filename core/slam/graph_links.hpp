// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// Which nodes a graph ties together, and over how many metres: what drift grows with.
class GraphLinks {
 public:
  void add(const Edge& edge);

  /// Metres of the shortest way from a node to every other of `nodes`; infinite where none leads.
  [[nodiscard]] std::vector<double> distances_m(std::size_t nodes, std::size_t from) const;

 private:
  std::vector<std::vector<std::pair<std::size_t, double>>> at_;  ///< neighbours of each node, metres
};

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// The nodes that a graph connects, and the path length between them in metres: drift grows with it.
class GraphLinks {
 public:
  /// `turn_on_spot_m`: GraphParams.
  explicit GraphLinks(double turn_on_spot_m) : turn_on_spot_m_(turn_on_spot_m) {}

  /// `loose_m`: added to the edge's length, where more drift is to be expected than on its way.
  void add(const Edge& edge, double loose_m = 0.0);

  /// Length in metres of the shortest path from a node to every other of `nodes`; infinite without one.
  [[nodiscard]] std::vector<double> distances_m(std::size_t nodes, std::size_t from) const;

 private:
  double turn_on_spot_m_;
  std::vector<std::vector<std::pair<std::size_t, double>>> at_;  ///< neighbours of each node, metres
};

}  // namespace topo::slam

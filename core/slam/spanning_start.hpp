// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// Poses chained along a spanning tree from node 0, which is put at `first`. `ranks`: of each edge; the tree
/// is of the edges of the least rank, and of those of one rank of the earlier in the list, whatever the
/// nodes' numbers are. Nothing when the edges do not tie all nodes together.
std::optional<std::vector<types::Se2>> spanning_start(std::size_t nodes, std::span<const Edge> edges,
                                                      std::span<const int> ranks,
                                                      const types::Se2& first = {});

/// The same of one robot's nodes, numbered along its way: the edges between successive nodes wherever there
/// is one (dead reckoning), other edges only where nothing else reaches a node.
std::optional<std::vector<types::Se2>> spanning_start(std::size_t nodes, std::span<const Edge> edges,
                                                      const types::Se2& first = {});

}  // namespace topo::slam

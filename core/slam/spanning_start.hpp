// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// Poses chained along a spanning tree from node 0, which is placed at `first`. `ranks`: one per edge; the
/// tree prefers edges of lower rank, and within one rank those earlier in the list, independent of the nodes'
/// numbers. Empty when the edges do not connect all nodes.
std::optional<std::vector<types::Se2>> spanning_start(std::size_t nodes, std::span<const Edge> edges,
                                                      std::span<const int> ranks,
                                                      const types::Se2& first = {});

/// The same for the nodes of one robot, numbered along its path: edges between successive nodes (dead
/// reckoning) are preferred; other edges are used only where nothing else reaches a node.
std::optional<std::vector<types::Se2>> spanning_start(std::size_t nodes, std::span<const Edge> edges,
                                                      const types::Se2& first = {});

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/pose_graph.hpp"
#include "core/slam/search.hpp"

namespace topo::slam {

/// A run of keyframes of another visit near a node.
struct LoopRun {
  std::size_t first = 0, last = 0;  ///< nodes, inclusive
  std::size_t nearest = 0;
  SearchWindow window;
};

/// Where a node may have been before: runs of consecutive nodes that are near, given how far the estimate may
/// have drifted along the shortest way through the graph, and that the path left in between.
/// Nearest first, at most `groups_max`. Pure.
std::vector<LoopRun> find_loop_runs(std::span<const types::Se2> poses, std::span<const Edge> edges,
                                    std::size_t node, const LoopParams& params);

}  // namespace topo::slam

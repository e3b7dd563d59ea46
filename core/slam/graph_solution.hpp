// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// The pose graph as it stood when something new was in it: a question to the loop closure thread. Values;
/// nothing in it changes any more.
struct GraphQuery {
  std::vector<types::Se2> poses;
  std::vector<Edge> edges;
  GraphParams params;
};

/// Its nodes' corrected poses. Not solved: nothing came of it, and the same may be asked again.
struct GraphSolution {
  std::vector<types::Se2> poses;
  SolveReport report;
};

/// Pure; any thread.
GraphSolution solve_graph(const GraphQuery& query);

/// Poses of all nodes once the first of them were corrected: a node that came since keeps its place beside
/// the earlier node that the first edge ties it to. `poses`: of all nodes as they stand; `edges`: those that
/// came since.
std::vector<types::Se2> corrected_poses(std::vector<types::Se2> solved, std::span<const types::Se2> poses,
                                        std::span<const Edge> edges);

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/heading_evidence.hpp"
#include "core/slam/keyframe.hpp"
#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// A snapshot of the pose graph with new edges and the evidence beside them (query_of), as a request to the
/// loop closure thread. Value type, immutable once created.
struct GraphQuery {
  std::vector<types::Se2> poses;
  std::vector<Edge> edges;
  GraphParams params;
  std::size_t fixed = 0;  ///< the node that keeps its pose
  std::vector<Heading> headings{};
};

/// The corrected poses of its nodes. When not solved, the poses are unchanged and the same request may be
/// repeated.
struct GraphSolution {
  std::vector<types::Se2> poses;
  SolveReport report;
};

/// A request to solve a map's graph: its edges with what odometry (odometry_evidence.hpp) and walls
/// (heading_evidence.hpp) say beside them.
GraphQuery query_of(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                    std::span<const Edge> edges, std::size_t fixed, const GraphParams& params);

/// Pure function; callable from any thread.
GraphSolution solve_graph(const GraphQuery& query);

/// Asks and solves again, as walls are read at the poses: until the same keyframes have headings, four times
/// at most.
GraphSolution solve_settled(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                            std::span<const Edge> edges, std::size_t fixed, const GraphParams& params);

/// Poses of all nodes after the first of them were corrected: a newer node keeps its pose relative to the
/// earlier node of its first edge, or without an edge to the node before it. `poses`: current poses of all
/// nodes; `edges`: those added since the request.
std::vector<types::Se2> corrected_poses(std::vector<types::Se2> solved, std::span<const types::Se2> poses,
                                        std::span<const Edge> edges);

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/slam/pose_graph.hpp"
#include "core/types/result.hpp"
#include "tests/bench/carmen/line_source.hpp"
#include "tests/bench/topobench/posegraph/node_name.hpp"

namespace topo::bench {

/// A pose graph of the community's text formats. Nodes are numbered 0.. in ascending order of the file's
/// names.
struct GraphFile {
  std::vector<NodeName> names;    ///< what the file calls each node
  std::vector<types::Se2> poses;  ///< the file's estimate; empty when it has no vertex lines
  std::vector<slam::Edge> edges;
  std::vector<std::size_t> fixed;    ///< the nodes that FIX lines name, ascending, each once
  std::vector<std::string> remarks;  ///< on lines that were passed over, a sentence each
};

/// Reads a plane graph, packed (.gz, .bz2) or not; lines that begin with `#` are comments.
///   g2o:  VERTEX_SE2 id x y theta | EDGE_SE2 from to x y theta I11 I12 I13 I22 I23 I33 | FIX id ...
///   TORO: VERTEX2 id x y theta    | EDGE2 from to x y theta I11 I12 I22 I33 I13 I23
/// Lines that say nothing of relative poses in the plane (parameters, scans, EQUIV) are passed over, with a
/// remark. kInvalidInput says file, line, what was found and what would be right: constraints of other kinds,
/// both formats in one file, a node given twice or an edge to none, an edge from a node to itself, numbers
/// that are none, an information matrix that is missing or not positive semidefinite, several fixed nodes
/// without poses, no edge at all, nodes that neither a chain of edges nor FIX ties to the others.
types::Result<GraphFile> read_graph(const std::string& path);
types::Result<GraphFile> read_graph(LineSource source);

}  // namespace topo::bench

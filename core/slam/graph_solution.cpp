// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_solution.hpp"

#include <algorithm>
#include <utility>

namespace topo::slam {

GraphSolution solve_graph(const GraphQuery& query) {
  GraphSolution solution{query.poses, {}};
  solution.report = solve_consistently(solution.poses, query.edges, query.params);
  return solution;
}

std::vector<types::Se2> corrected_poses(std::vector<types::Se2> solved, std::span<const types::Se2> poses,
                                        std::span<const Edge> edges) {
  const std::size_t first = solved.size();
  std::vector<std::size_t> beside(poses.size() - first);
  for (std::size_t k = 0; k < beside.size(); ++k) beside[k] = first + k - 1;
  for (std::size_t i = edges.size(); i-- > 0;) {
    const auto [earlier, later] = std::minmax(edges[i].from, edges[i].to);
    if (later >= first) beside[later - first] = earlier;
  }
  for (std::size_t node = first; node < poses.size(); ++node) {
    const std::size_t anchor = beside[node - first];
    solved.push_back(solved[anchor] * (poses[anchor].inverse() * poses[node]));
  }
  return solved;
}

}  // namespace topo::slam

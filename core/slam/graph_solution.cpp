// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/graph_solution.hpp"

#include <algorithm>
#include <utility>

#include "core/slam/odometry_evidence.hpp"

namespace topo::slam {

GraphQuery query_of(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                    std::span<const Edge> edges, std::size_t fixed, const GraphParams& params) {
  return {{poses.begin(), poses.end()},
          with_odometry(keyframes, edges, params.odometry),
          params,
          fixed,
          heading_evidence(keyframes, poses, params.heading)};
}

GraphSolution solve_graph(const GraphQuery& query) {
  GraphSolution solution{query.poses, {}};
  if (query.headings.empty()) {
    solution.report = solve_consistently(solution.poses, query.edges, query.params, query.fixed);
    return solution;
  }
  CompassGraph graph =
      with_compass(query.poses, query.edges, query.headings, query.fixed, query.params.heading);
  const std::size_t axes = query.poses.size();
  solution.report = solve_consistently(graph.poses, graph.edges, query.params, axes);
  if (!solution.report.solved) return solution;
  const types::Se2 T_map_axes = query.poses[query.fixed] * graph.poses[query.fixed].inverse();
  for (std::size_t node = 0; node < axes; ++node) {
    if (node != query.fixed) solution.poses[node] = T_map_axes * graph.poses[node];
  }
  return solution;
}

GraphSolution solve_settled(std::span<const KeyframePtr> keyframes, std::span<const types::Se2> poses,
                            std::span<const Edge> edges, std::size_t fixed, const GraphParams& params) {
  constexpr int kSolutionsMax = 4;
  GraphQuery query = query_of(keyframes, poses, edges, fixed, params);
  GraphSolution solution = solve_graph(query);
  const double chi2_start = solution.report.chi2_start;
  for (int solutions = 1; solutions < kSolutionsMax; ++solutions) {
    GraphQuery again = query_of(keyframes, solution.poses, edges, fixed, params);
    if (std::ranges::equal(again.headings, query.headings, {}, &Heading::node, &Heading::node)) break;
    GraphSolution next = solve_graph(again);
    if (!next.report.solved) break;
    query = std::move(again);
    solution = std::move(next);
  }
  solution.report.chi2_start = chi2_start;
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

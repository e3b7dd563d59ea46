// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/posegraph/posegraph_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "core/slam/linear_start.hpp"
#include "core/slam/spanning_start.hpp"
#include "tests/bench/topobench/posegraph/graph_file.hpp"

namespace topo::bench {
namespace {

/// Limits of a solution that is to be compared with others': iterated to the rounding, not for a robot.
slam::GraphParams exact_params() {
  slam::GraphParams params;
  params.iterations_max = 200;
  params.converged = 1e-8;
  return params;
}

struct Solution {
  double chi2_start = 0.0;
  slam::SolveReport report;
};

/// Nodes that follow each other on one robot's path, as dead reckoning ties them.
bool successive(const GraphFile& file, const slam::Edge& edge) {
  const auto [first, second] = std::minmax(edge.from, edge.to);
  return second - first == 1 && file.names[first].robot() == file.names[second].robot();
}

/// Chained along the paths; fixed nodes are tied to each other by the poses that the file holds them at.
std::vector<types::Se2> dead_reckoning(const GraphFile& file) {
  std::vector<slam::Edge> edges = file.edges;
  std::vector<int> ranks;
  for (const slam::Edge& edge : edges) ranks.push_back(successive(file, edge) ? 1 : 2);
  for (std::size_t k = 1; k < file.fixed.size(); ++k) {
    slam::Edge& tie = edges.emplace_back();
    tie.from = file.fixed.front();
    tie.to = file.fixed[k];
    tie.T_from_to = file.poses[tie.from].inverse() * file.poses[tie.to];
    ranks.push_back(0);
  }
  // The reader has seen to it that there is one.
  std::vector<types::Se2> poses = slam::spanning_start(file.names.size(), edges, ranks).value_or(file.poses);
  if (file.fixed.size() < 2) return poses;
  const types::Se2 T_file_start = file.poses[file.fixed.front()] * poses[file.fixed.front()].inverse();
  for (types::Se2& pose : poses) pose = T_file_start * pose;
  for (const std::size_t node : file.fixed) poses[node] = file.poses[node];
  return poses;
}

/// From dead reckoning, or from the linear estimate where that explains the edges better.
Solution solve_from_odometry(const GraphFile& file) {
  std::vector<std::size_t> fixed = file.fixed;
  if (fixed.empty()) fixed.push_back(0);
  Solution solution;
  std::vector<types::Se2> poses = dead_reckoning(file);
  solution.chi2_start = slam::total_chi2(poses, file.edges);
  std::vector<types::Se2> linear = poses;
  if (slam::start_linearly(linear, file.edges, fixed) &&
      slam::total_chi2(linear, file.edges) < solution.chi2_start)
    poses = std::move(linear);
  solution.report = slam::solve(poses, file.edges, exact_params(), fixed);
  return solution;
}

}  // namespace

types::Status run_posegraph(const PosegraphCommand& command) {
  auto file = read_graph(command.file);
  if (!file) return tl::unexpected(file.error());
  for (const std::string& remark : file->remarks)
    fmt::print(stderr, "topobench: {}: {}\n", command.file, remark);
  if (command.robust) {
    for (slam::Edge& edge : file->edges) edge.robust = !successive(*file, edge);
  }
  const auto begin = std::chrono::steady_clock::now();
  const Solution solution = solve_from_odometry(*file);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  if (!solution.report.solved)
    return types::fail(types::Errc::kInvalidInput,
                       fmt::format("{}: found a singular system, expected edges whose information together "
                                   "determines every node",
                                   command.file));
  const nlohmann::json json{{"file", command.file},
                            {"nodes", file->names.size()},
                            {"edges", file->edges.size()},
                            {"fixed", file->fixed.size()},
                            {"chi2_start", solution.chi2_start},
                            {"chi2_linear_start", solution.report.chi2_start},
                            {"chi2_end", solution.report.chi2_end},
                            {"iterations", solution.report.iterations},
                            {"wall_s", wall.count()}};
  fmt::print("{}\n", command.json ? json.dump() : json.dump(2));
  return {};
}

}  // namespace topo::bench

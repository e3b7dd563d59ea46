// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/bench/topobench/posegraph/posegraph_command.hpp"

#include <fmt/format.h>

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

/// From dead reckoning, or from the linear estimate where that explains the edges better.
Solution solve_from_odometry(const GraphFile& file, std::vector<types::Se2> poses) {
  const std::size_t fixed = file.fixed.value_or(0);
  Solution solution;
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
  if (command.robust) {
    for (slam::Edge& edge : file->edges) edge.robust = edge.to != edge.from + 1 && edge.from != edge.to + 1;
  }
  const auto begin = std::chrono::steady_clock::now();
  auto odometry = slam::spanning_start(file->ids.size(), file->edges);
  // The reader has seen to it that there is one.
  const Solution solution = solve_from_odometry(*file, std::move(*odometry));
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  if (!solution.report.solved)
    return types::fail(types::Errc::kInvalidInput,
                       fmt::format("{}: found a singular system, expected edges whose information together "
                                   "determines every node",
                                   command.file));
  const nlohmann::json json{{"file", command.file},
                            {"nodes", file->ids.size()},
                            {"edges", file->edges.size()},
                            {"chi2_start", solution.chi2_start},
                            {"chi2_linear_start", solution.report.chi2_start},
                            {"chi2_end", solution.report.chi2_end},
                            {"iterations", solution.report.iterations},
                            {"wall_s", wall.count()}};
  fmt::print("{}\n", command.json ? json.dump() : json.dump(2));
  return {};
}

}  // namespace topo::bench

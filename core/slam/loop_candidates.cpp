// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/loop_candidates.hpp"

#include <algorithm>
#include <cmath>

namespace topo::slam {
namespace {

double distance(const types::Se2& a, const types::Se2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

SearchWindow window_for(double graph_distance, const LoopParams& params) {
  return {std::min(params.search_max_m, params.search_floor_m + params.drift_per_m * graph_distance),
          std::min(params.search_max_rad, params.search_floor_rad + params.drift_per_m_rad * graph_distance)};
}

LoopRun around(std::size_t nearest, std::size_t end, const LoopParams& params) {
  const auto half = static_cast<std::size_t>(params.group_half);
  LoopRun run;
  run.nearest = nearest;
  run.first = nearest > half ? nearest - half : 0;
  run.last = std::min(nearest + half, end - 1);
  return run;
}

}  // namespace

std::size_t end_of_other_visits(std::span<const types::Se2> poses, Way way, std::size_t at,
                                const LoopParams& params) {
  double travelled = 0.0;
  std::size_t last = at;
  while (last > 0 && travelled < params.chain_gap_m) {
    travelled += distance(poses[way[last]], poses[way[last - 1]]);
    --last;
  }
  return travelled < params.chain_gap_m ? 0 : last + 1;
}

std::vector<LoopRun> find_loop_runs(std::span<const types::Se2> poses, std::span<const double> distances_m,
                                    std::size_t node, Way way, std::size_t end, const LoopParams& params) {
  std::vector<LoopRun> runs;
  std::size_t previous = 0;
  bool open = false;
  for (std::size_t i = 0; i < end; ++i) {
    const double d = distance(poses[way[i]], poses[node]);
    const SearchWindow window = window_for(distances_m[way[i]], params);
    if (d > params.radius_m + window.half_m) continue;
    const bool next = !open || i > previous + 3;
    open = true;
    previous = i;
    if (next) runs.emplace_back();
    if (!next && d >= runs.back().distance_m) continue;
    runs.back() = around(i, end, params);
    runs.back().distance_m = d;
    runs.back().window = window;
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const LoopRun& a, const LoopRun& b) { return a.distance_m < b.distance_m; });
  if (runs.size() > static_cast<std::size_t>(params.groups_max))
    runs.resize(static_cast<std::size_t>(params.groups_max));
  return runs;
}

}  // namespace topo::slam

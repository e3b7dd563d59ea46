// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/loop_candidates.hpp"

#include <algorithm>

namespace topo::slam {
namespace {

SearchWindow window_for(double graph_distance, const LoopParams& params) {
  return {std::min(params.search_max_m, params.search_floor_m + params.drift_per_m * graph_distance),
          std::min(params.search_max_rad, params.search_floor_rad + params.drift_per_m_rad * graph_distance)};
}

/// The run around the nearest keyframe: on either side `count` keyframes, and as many as the search window
/// reaches along the path. Where the window extends beyond the map, only wrong places can fit.
LoopRun around(std::span<const types::Se2> poses, Way way, std::size_t nearest, std::size_t end,
               const SearchWindow& window, std::size_t count) {
  LoopRun run{nearest, nearest, nearest, window, 0.0};
  double way_m = 0.0;
  while (run.first > 0 && (nearest - run.first < count || way_m < window.half_m)) {
    way_m += distance_m(poses[way[run.first]], poses[way[run.first - 1]]);
    --run.first;
  }
  way_m = 0.0;
  while (run.last + 1 < end && (run.last - nearest < count || way_m < window.half_m)) {
    way_m += distance_m(poses[way[run.last]], poses[way[run.last + 1]]);
    ++run.last;
  }
  return run;
}

}  // namespace

std::size_t end_of_other_visits(std::span<const types::Se2> poses, Way way, std::size_t at,
                                const LoopParams& params) {
  double travelled = 0.0;
  std::size_t last = at;
  while (last > 0 && travelled < params.chain_gap_m) {
    travelled += distance_m(poses[way[last]], poses[way[last - 1]]);
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
    const double d = distance_m(poses[way[i]], poses[node]);
    const SearchWindow window = window_for(distances_m[way[i]], params);
    if (d > params.radius_m + window.half_m) continue;
    const bool next = !open || i > previous + params.run_gap;
    open = true;
    previous = i;
    if (next) runs.emplace_back();
    if (!next && d >= runs.back().distance_m) continue;
    runs.back() = around(poses, way, i, end, window, static_cast<std::size_t>(params.group_half));
    runs.back().distance_m = d;
  }
  std::stable_sort(runs.begin(), runs.end(),
                   [](const LoopRun& a, const LoopRun& b) { return a.distance_m < b.distance_m; });
  if (runs.size() > static_cast<std::size_t>(params.groups_max))
    runs.resize(static_cast<std::size_t>(params.groups_max));
  return runs;
}

}  // namespace topo::slam

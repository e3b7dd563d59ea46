// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/params.hpp"
#include "core/slam/search.hpp"

namespace topo::slam {

/// The nodes of one robot, in the order of its path.
using Way = std::span<const std::size_t>;

/// A run of keyframes of another visit near a node.
struct LoopRun {
  std::size_t first = 0, last = 0;  ///< indices into the path, inclusive
  std::size_t nearest = 0;
  SearchWindow window;
  double distance_m = 0.0;  ///< of the nearest
};

/// Returns `end`: the indices [0, end) of a path belong to another visit than the index `at`, because the
/// path length between them is at least the gap.
std::size_t end_of_other_visits(std::span<const types::Se2> poses, Way way, std::size_t at,
                                const LoopParams& params);

/// The runs among the indices [0, end) of a path that a node may revisit: those that are near, given the
/// possible drift of the estimate (`distances_m`: GraphLinks::distances_m from the node). Nearest first, at
/// most `groups_max`. Pure function.
std::vector<LoopRun> find_loop_runs(std::span<const types::Se2> poses, std::span<const double> distances_m,
                                    std::size_t node, Way way, std::size_t end, const LoopParams& params);

}  // namespace topo::slam

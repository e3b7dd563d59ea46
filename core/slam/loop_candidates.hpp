// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/params.hpp"
#include "core/slam/search.hpp"

namespace topo::slam {

/// The nodes that one robot made, in the order of its way.
using Way = std::span<const std::size_t>;

/// A run of keyframes of another visit near a node.
struct LoopRun {
  std::size_t first = 0, last = 0;  ///< places on the way, inclusive
  std::size_t nearest = 0;
  SearchWindow window;
  double distance_m = 0.0;  ///< of the nearest
};

/// Places [0, end) of a way are of another visit than the place `at`: the path left in between is longer than
/// the gap.
std::size_t end_of_other_visits(std::span<const types::Se2> poses, Way way, std::size_t at,
                                const LoopParams& params);

/// Where on the places [0, end) of a way a node may have been: runs of places that are near, given how far
/// the estimate may have drifted (`distances_m`: GraphLinks::distances_m from the node). Nearest first, at
/// most `groups_max`. Pure.
std::vector<LoopRun> find_loop_runs(std::span<const types::Se2> poses, std::span<const double> distances_m,
                                    std::size_t node, Way way, std::size_t end, const LoopParams& params);

}  // namespace topo::slam

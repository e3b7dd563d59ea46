// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/loop_candidates.hpp"
#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// For each edge between successive keyframes of a path, by the place of the second: whether a closure that
/// the poses obey (squared error up to `contradicted_chi2`) spans it. What a closure spans is not further off
/// than the closure.
[[nodiscard]] std::vector<bool> spanned_by_closures(std::span<const Edge> edges,
                                                    std::span<const types::Se2> poses, Way way,
                                                    double contradicted_chi2);

/// An edge that is no closure between two neighbours on a path: how the robot came from one to the other.
struct WayStep {
  const Edge* edge = nullptr;  ///< of the list that was given
  std::size_t place = 0;       ///< on the path, of the second
  bool spanned = false;        ///< by a closure that the poses obey
};

/// The steps of a path, in the order of the edges. `edges` must outlive them.
[[nodiscard]] std::vector<WayStep> way_steps(std::span<const Edge> edges, std::span<const types::Se2> poses,
                                             Way way, double contradicted_chi2);

}  // namespace topo::slam

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// Initial poses for the least squares, computed without a prior estimate by two linear systems: headings
/// from the relaxed rotations (chordal relaxation), then positions with these headings (Carlone et al.,
/// Initialization techniques for 3D SLAM, 2015, section III-B, in the plane). Outliers are not rejected: only
/// for graphs with trusted edges. Node `fixed` keeps its pose. False, with the poses unchanged, when the
/// edges do not connect all nodes or a system is singular.
bool start_linearly(std::vector<types::Se2>& poses, std::span<const Edge> edges, std::size_t fixed = 0);

/// The same with several nodes at their poses; there must be one at least.
bool start_linearly(std::vector<types::Se2>& poses, std::span<const Edge> edges,
                    std::span<const std::size_t> fixed);

}  // namespace topo::slam

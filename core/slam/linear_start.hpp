// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/slam/pose_graph.hpp"

namespace topo::slam {

/// Poses to start the least squares from that owe nothing to an estimate: headings from the relaxed rotations
/// (chordal relaxation), then positions with these headings, two linear systems (Carlone et al.,
/// Initialization techniques for 3D SLAM, 2015, section III-B, in the plane). Outliers are not recognised:
/// for graphs whose edges are believed. Node `fixed` keeps its pose. False, and poses unchanged, when the
/// edges do not tie all nodes together or a system is singular.
bool start_linearly(std::vector<types::Se2>& poses, std::span<const Edge> edges, std::size_t fixed = 0);

}  // namespace topo::slam

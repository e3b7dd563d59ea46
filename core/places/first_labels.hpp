// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/skeleton.hpp"

namespace topo::places {

/// The over-segmentation that the reduction begins with (paper section II-C).
struct FirstLabels {
  std::vector<std::uint32_t> labels;  ///< piece + 1, 0 outside free space; as map.cells
  std::uint32_t pieces = 0;
};

/// Every axis cell gets the label of the node nearest to it along the axis, and every free cell that of the
/// axis cell to which the steepest way up the distance map leads; linear in the cells. Three departures from
/// the paper put borders where a person would: steepest ascent instead of nearest axis cell, so that a border
/// between two labels of the axis runs straight across a doorway and not in a bow into the room; an edge is
/// divided at its narrow passages (doors) rather than half-way between its nodes; and a long one into pieces
/// of `piece_m`, as if it had nodes there.
FirstLabels first_labels(const grid::DenseMap& map, std::span<const float> clearance_m,
                         const Skeleton& skeleton, double piece_m);

}  // namespace topo::places

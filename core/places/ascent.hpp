// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Gives free cells without a label the one that the steepest way up the distance map leads to; on a ridge
/// that was taken away, that of a neighbour which has one. Returns the free cells that have none afterwards:
/// their way up ends beside the labels that there were.
std::vector<std::uint32_t> climb_to_labels(const grid::DenseMap& map, std::span<const float> clearance_m,
                                           std::vector<std::uint32_t>& labels);

}  // namespace topo::places

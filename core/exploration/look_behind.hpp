// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/exploration/params.hpp"
#include "core/grid/dense_map.hpp"
#include "core/types/se2.hpp"

namespace topo::exploration {

/// Heading in map from which the front scanner sees what is unknown behind the robot; empty when what lies
/// there is known. A robot that drives knows the ground behind it. One that has just begun does not: it may
/// stand before a wall, with its back to the whole building. Cost: the cells of a circle of `reach_m`.
std::optional<double> heading_to_unseen(const grid::DenseMap& map, const types::Se2& T_map_base,
                                        const LookBehindParams& params);

}  // namespace topo::exploration

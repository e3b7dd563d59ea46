// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/grid/wavefront.hpp"

namespace topo::grid {

/// The reachable cell nearest to `goal` (straight line) within `within_m`; the goal itself when reachable.
std::optional<CellIndex> nearest_reachable(const DenseMap& map, const TravelField& field, CellIndex goal,
                                           double within_m);

/// The same among the cells at which the robot can stay (TravelField::can_stay_at).
std::optional<CellIndex> nearest_to_stay_at(const DenseMap& map, const TravelField& field, CellIndex goal,
                                            double within_m);

}  // namespace topo::grid

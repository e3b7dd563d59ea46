// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/compass/points_change.hpp"
#include "core/grid/dense_map.hpp"
#include "core/grid/rows.hpp"
#include "core/types/geometry.hpp"

namespace topo::compass {

/// Centres of the occupied cells on the surface of what is occupied, row by row: a side of theirs is not. The
/// inside of a solid mass, as drawn maps have it, says nothing of walls, and can be most of the map.
std::vector<types::Vector2> occupied_points(const grid::DenseMap& map);

/// The same of one map after the other. A value.
class OccupiedPoints {
 public:
  /// `others`: the rows that are not as on the map taken before; all of them when that had another box or
  /// resolution. Costs those rows. Good until the next call.
  PointsChange take(const grid::DenseMap& map, grid::Rows others);

 private:
  std::vector<types::Vector2> points_;
};

}  // namespace topo::compass

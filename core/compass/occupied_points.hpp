// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/compass/points_change.hpp"
#include "core/grid/dense_map.hpp"
#include "core/grid/rows.hpp"
#include "core/types/geometry.hpp"

namespace topo::compass {

/// Centres of the occupied cells with a straight neighbour that is not occupied, row by row. The inside of a
/// solid mass, as in drawn maps, carries no information about walls and can be most of the map.
std::vector<types::Vector2> occupied_points(const grid::DenseMap& map);

/// The same for successive maps. Value type.
class OccupiedPoints {
 public:
  /// `others`: the rows that differ from the previous map; all rows when that had another box or resolution.
  /// The cost is that of those rows. The result is valid until the next call.
  PointsChange take(const grid::DenseMap& map, grid::Rows others);

 private:
  std::vector<types::Vector2> points_;
};

}  // namespace topo::compass

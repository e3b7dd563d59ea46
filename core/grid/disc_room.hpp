// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::grid {

/// Cells of a small box at which the centre of a disc can be without the disc touching an occupied cell.
/// Unknown cells and cells outside the map count as free. A search that closes visited cells may use it as
/// its set of open cells.
class DiscRoom {
 public:
  /// `radius_m`: radius of the disc, between cell centres. Linear in the box and the discs around occupied
  /// cells.
  DiscRoom(const DenseMap& map, const CellBox& box, double radius_m);

  /// False outside the box.
  [[nodiscard]] bool is_open(CellIndex cell) const { return contains(cell) && closed_[index(cell)] == 0; }
  /// Precondition: is_open(cell).
  void close(CellIndex cell) { closed_[index(cell)] = 1; }

 private:
  /// Closes the discs around cells [first, last] of row `y`; `half`: the half widths of a disc's rows.
  void close_around(std::int32_t y, std::int32_t first, std::int32_t last,
                    std::span<const std::int32_t> half);
  [[nodiscard]] bool contains(CellIndex c) const {
    return c.x >= box_.min.x && c.x <= box_.max.x && c.y >= box_.min.y && c.y <= box_.max.y;
  }
  [[nodiscard]] std::size_t index(CellIndex c) const {
    return static_cast<std::size_t>(c.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(c.x - box_.min.x);
  }

  CellBox box_;
  std::vector<std::uint8_t> closed_;
};

}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/grid/cell_blocks.hpp"
#include "core/grid/cell_run.hpp"
#include "core/grid/dense_map.hpp"
#include "core/grid/joined_runs.hpp"
#include "core/grid/rows.hpp"
#include "core/types/geometry.hpp"

namespace topo::places {

/// The map without furniture: connected cells (eight neighbours) that are not free, are surrounded by free
/// space and are at most `furniture_m` long along both axes become free. Chairs, tables, boxes and their
/// shadows are not part of a building's structure (paper section II-D), and they turn every room into a maze.
/// Cells along one of the walls stay: of a wall behind shelves only pieces are visible. Linear in the cells.
grid::DenseMap without_furniture(const grid::DenseMap& map, std::span<const types::Segment> walls,
                                 double furniture_m);

/// The same for successive maps: searches for furniture only around the changed cells. The result always
/// equals without_furniture() of the whole map. A value.
class FurnitureUpdate {
 public:
  /// Takes the next map, with its furniture. Returns the rows that differ from the previous map; all rows
  /// when that had another box or resolution.
  grid::Rows take(const grid::DenseMap& map, double furniture_m);

  /// The map taken last, which `map` must be, without furniture; call once per map. Valid until the next
  /// take().
  const grid::DenseMap& clear(const grid::DenseMap& map, std::span<const types::Segment> walls);

  /// Where cells of the map without furniture may differ from the previous one; without meaning when that had
  /// another box.
  [[nodiscard]] const grid::CellBlocks& others() const { return others_; }

  /// Moves the cleared map out.
  [[nodiscard]] grid::DenseMap release() && { return std::move(open_); }

 private:
  using Extent = grid::JoinedRuns::Extent;
  /// A row of a piece of furniture, and the extent of the whole piece.
  struct Piece {
    grid::CellRun run;
    Extent whole{};
  };

  void put_back();
  [[nodiscard]] Extent renew_cells(const grid::DenseMap& map);
  void note_pieces();
  void find_pieces(const Extent& changed);
  void clear_away();

  grid::DenseMap open_;
  std::size_t side_ = 0;  ///< largest length of furniture, in cells
  std::vector<Piece> pieces_;
  std::vector<grid::CellState> hidden_;  ///< the pieces' cells in the map, in the order of the pieces
  grid::CellBlocks others_{0};
};

}  // namespace topo::places

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

/// The map without what stands about in its free space: connected cells (eight neighbours) that are not free,
/// surrounded by free space, no longer than `furniture_m` along either axis, become free. Chairs, tables,
/// boxes and their shadows say nothing of a building's structure (paper section II-D), and with them every
/// room is a maze. What lies along one of the walls stays: of a wall behind shelves only pieces are seen.
/// Linear in the cells.
grid::DenseMap without_furniture(const grid::DenseMap& map, std::span<const types::Segment> walls,
                                 double furniture_m);

/// The same of one map after the other: what stands about is looked for anew around the cells that have
/// changed. Always equal to without_furniture of the whole map. A value.
class FurnitureUpdate {
 public:
  /// Of the next map, with its furniture. Returns the rows that are not as on the one before; all of them
  /// when that had another box or resolution.
  grid::Rows take(const grid::DenseMap& map, double furniture_m);

  /// The map taken last, once; `map` is that. Good until the next one is taken.
  const grid::DenseMap& clear(const grid::DenseMap& map, std::span<const types::Segment> walls);

  /// Where cells of the map without furniture may not be as they were on the one before; of no meaning when
  /// that had another box.
  [[nodiscard]] const grid::CellBlocks& others() const { return others_; }

  /// What was cleared last, for the asking.
  [[nodiscard]] grid::DenseMap release() && { return std::move(open_); }

 private:
  using Extent = grid::JoinedRuns::Extent;
  /// A row of what stands about, and what all of it spans.
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
  std::size_t side_ = 0;  ///< what stands about is no longer, in cells
  std::vector<Piece> pieces_;
  std::vector<grid::CellState> hidden_;  ///< the pieces' cells in the map, one piece after the other
  grid::CellBlocks others_{0};
};

}  // namespace topo::places

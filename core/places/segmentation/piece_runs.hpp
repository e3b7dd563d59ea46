// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/cell_blocks.hpp"
#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Cells with one label side by side.
struct PieceRun {
  std::uint32_t first;  ///< cell
  std::uint32_t end;    ///< the cell after its last
  std::uint32_t label;
  float clearance_m;  ///< of its clearest cell
  friend bool operator==(const PieceRun&, const PieceRun&) = default;
};

/// All with a label, which free cells alone have, in rising order.
std::vector<PieceRun> piece_runs(const grid::DenseMap& map, std::span<const float> clearance_m,
                                 std::span<const std::uint32_t> labels);

/// The same from those before labels or clearances changed in some blocks of cells.
std::vector<PieceRun> renewed_runs(std::span<const PieceRun> before, const grid::CellBlocks& changed,
                                   std::span<const float> clearance_m, std::span<const std::uint32_t> labels);

}  // namespace topo::places

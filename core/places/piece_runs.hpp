// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/first_labels.hpp"

namespace topo::places {

/// Free cells of one piece side by side.
struct PieceRun {
  std::uint32_t first;  ///< cell
  std::uint32_t end;    ///< the cell after its last
  std::uint32_t piece;  ///< number in FirstLabels::pieces
};

/// All that have a label, in rising order.
std::vector<PieceRun> piece_runs(const grid::DenseMap& map, const FirstLabels& first);

}  // namespace topo::places

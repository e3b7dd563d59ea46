// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"

namespace topo::places {

/// Adjacent cells of a row with the same label.
struct PieceRun {
  std::uint32_t first;  ///< cell
  std::uint32_t end;    ///< the cell after its last one
  std::uint32_t label;
  float clearance_m;  ///< largest of its cells
  friend bool operator==(const PieceRun&, const PieceRun&) = default;
};

/// All runs with a label, in ascending order. Only free cells have labels.
std::vector<PieceRun> piece_runs(const grid::DenseMap& map, std::span<const float> clearance_m,
                                 std::span<const std::uint32_t> labels);

}  // namespace topo::places

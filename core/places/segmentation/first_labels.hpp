// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/piece_runs.hpp"
#include "core/places/segmentation/place_map.hpp"
#include "core/places/skeleton/cell_numbers.hpp"
#include "core/places/skeleton/skeleton.hpp"

namespace topo::places {

/// The over-segmentation with which the reduction begins (paper section II-C), and the data from which it was
/// made.
struct FirstLabels {
  grid::CellBox box;                  ///< of the map
  std::vector<std::uint32_t> labels;  ///< label of the cell's piece, 0 outside free space; as map.cells
  /// The pieces' labels: 1 + the lowest axis cell of a piece.
  std::vector<std::uint32_t> pieces;
  std::vector<std::uint32_t> axis;
  std::vector<std::uint32_t> axis_pieces;  ///< of each axis cell, its index in `pieces`
  std::vector<PieceRun> runs;
  std::vector<std::uint32_t> run_pieces;  ///< of each run, its index in `pieces`
};

/// The number of a piece, from its label.
class PieceNumbers {
 public:
  PieceNumbers(const FirstLabels& first, std::size_t cells) : numbers_(cells) {
    for (std::uint32_t p = 0; p < first.pieces.size(); ++p) numbers_.set(first.pieces[p] - 1, p);
  }
  [[nodiscard]] std::uint32_t of(std::uint32_t label) const { return numbers_.at(label - 1); }

 private:
  CellNumbers numbers_;
};

/// Gives every axis cell the label of the nearest node along the axis, and every free cell the label of the
/// axis cell to which the steepest ascent of the distance map leads; linear in the cells. Three deviations
/// from the paper give more natural borders. Steepest ascent replaces the nearest axis cell, so that a border
/// between two labels runs straight across a doorway and does not bulge into the room. An edge is divided at
/// its narrow passages (doors) instead of half-way between its nodes. A long edge is divided into pieces of
/// `piece_m`, as if it had nodes there.
FirstLabels first_labels(const grid::DenseMap& map, std::span<const float> clearance_m,
                         const Skeleton& skeleton, const FirstLabelParams& params);

}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/grid/cell_run.hpp"
#include "core/grid/dense_map.hpp"
#include "core/places/segmentation/piece_runs.hpp"
#include "core/places/segmentation/slopes.hpp"
#include "core/places/skeleton/cell_numbers.hpp"
#include "core/places/skeleton/skeleton.hpp"

namespace topo::places {

/// How first labels differ from those that they were made of.
struct LabelChange {
  /// Where there may be cells with another label, another clearance, or another relation to the axis.
  std::vector<grid::CellRun> cells;
  std::vector<std::uint32_t> pieces;  ///< all with such a cell, before or now, by their labels: ascending
};

/// The over-segmentation that the reduction begins with (paper section II-C), and what it was made of.
struct FirstLabels {
  grid::CellBox box;                  ///< of the map
  std::vector<std::uint32_t> labels;  ///< its piece's, 0 outside free space; as map.cells
  /// The pieces' labels: the lowest cell of a piece on the axis + 1, so that of a piece that stays as it was
  /// on another map no cell changes.
  std::vector<std::uint32_t> pieces;
  std::vector<Slope> slopes;
  std::vector<std::uint32_t> axis;
  std::vector<std::uint32_t> axis_pieces;  ///< of each of its cells, numbers in `pieces`
  std::vector<std::uint32_t> lost;         ///< cells that do not lead up to the axis
  std::vector<PieceRun> runs;
  std::vector<std::uint32_t> run_pieces;  ///< of each of them
  std::optional<LabelChange> change;      ///< nothing: they were made anew
};

/// The number of a piece by its label.
class PieceNumbers {
 public:
  PieceNumbers(const FirstLabels& first, std::size_t cells) : numbers_(cells) {
    for (std::uint32_t p = 0; p < first.pieces.size(); ++p) numbers_.set(first.pieces[p] - 1, p);
  }
  [[nodiscard]] std::uint32_t of(std::uint32_t label) const { return numbers_.at(label - 1); }

 private:
  CellNumbers numbers_;
};

/// Every axis cell gets the label of the node nearest to it along the axis, and every free cell that of the
/// axis cell to which the steepest way up the distance map leads; linear in the cells. Three departures from
/// the paper put borders where a person would: steepest ascent instead of nearest axis cell, so that a border
/// between two labels of the axis runs straight across a doorway and not in a bow into the room; an edge is
/// divided at its narrow passages (doors) rather than half-way between its nodes; and a long one into pieces
/// of `piece_m`, as if it had nodes there.
FirstLabels first_labels(const grid::DenseMap& map, std::span<const float> clearance_m,
                         const Skeleton& skeleton, double piece_m);

/// Makes of the labels of another map with the same box those of this one. `changed`: the cells whose
/// clearance is not what it was there, ascending. Costs what leads up through a change, to another axis, or
/// to another piece.
void relabel(const grid::DenseMap& map, std::span<const float> clearance_m, const Skeleton& skeleton,
             double piece_m, std::span<const std::uint32_t> changed, FirstLabels& first);

}  // namespace topo::places

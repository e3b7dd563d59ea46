// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/first_labels.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "core/grid/clearance_update.hpp"
#include "core/grid/distance.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using grid::DenseMap;

const FirstLabelParams kPieces{0.4};

/// Rooms and corridors of even and odd widths: along the even ones half of what is clearest is not the axis.
DenseMap rooms() {
  DrawnMap drawn(*rc::gen::inRange(30, 120), *rc::gen::inRange(30, 90));
  drawn.free(2, 2, drawn.map().width() - 6, drawn.map().height() - 6);
  DenseMap map = drawn.map();
  draw_patches(map, *rc::gen::inRange(0, 20), 24);
  return map;
}

/// A map, and what is kept up with it.
struct Changing {
  Changing() {
    update.take(map);
    first = first_labels(map, update.clearance_m(), skeletonise(map, update.clearance_m()), kPieces);
  }

  DenseMap map = rooms();
  grid::ClearanceUpdate update;
  FirstLabels first;
};

TEST(FirstLabels, OfAxisAndRunsAreThoseOfTheirPieces) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = rooms();
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const FirstLabels first = first_labels(map, clearance_m, skeletonise(map, clearance_m), kPieces);
    RC_ASSERT(first.axis_pieces.size() == first.axis.size() && first.run_pieces.size() == first.runs.size());
    for (std::size_t k = 0; k < first.axis.size(); ++k)
      RC_ASSERT(first.pieces[first.axis_pieces[k]] == first.labels[first.axis[k]]);
    for (std::size_t k = 0; k < first.runs.size(); ++k)
      RC_ASSERT(first.pieces[first.run_pieces[k]] == first.runs[k].label);
  }));
}

TEST(FirstLabels, AreThoseOfThePiecesOnTheAxis) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = rooms();
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const FirstLabels first = first_labels(map, clearance_m, skeletonise(map, clearance_m), kPieces);
    for (const std::uint32_t label : first.pieces) RC_ASSERT(first.labels[label - 1] == label);
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const bool is_one =
          std::find(first.pieces.begin(), first.pieces.end(), first.labels[i]) != first.pieces.end();
      RC_ASSERT(is_one == (map.cells[i] == CellState::kFree));
    }
  }));
}

}  // namespace
}  // namespace topo::places

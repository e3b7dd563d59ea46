// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/first_labels.hpp"

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

constexpr double kPiece_m = 0.4;

/// Rooms and corridors of even and odd widths: along the even ones half of what is clearest is not the axis.
DenseMap rooms() {
  DrawnMap drawn(*rc::gen::inRange(30, 120), *rc::gen::inRange(30, 90));
  drawn.free(2, 2, drawn.map().width() - 6, drawn.map().height() - 6);
  DenseMap map = drawn.map();
  draw_patches(map, *rc::gen::inRange(0, 20), 24);
  return map;
}

TEST(FirstLabels, OfAMapThatChangedAreThoseOfTheWholeMap) {
  EXPECT_TRUE(rc::check([] {
    DenseMap map = rooms();
    grid::ClearanceUpdate update;
    update.take(map);
    FirstLabels first =
        first_labels(map, update.clearance_m(), skeletonise(map, update.clearance_m()), kPiece_m);
    for (int step = 0; step < 6; ++step) {
      draw_patches(map, *rc::gen::inRange(0, 4), *rc::gen::element(2, 8, 20));
      update.take(map);
      const Skeleton skeleton = skeletonise(map, update.clearance_m());
      relabel(map, update.clearance_m(), skeleton, kPiece_m, *update.changed(), first);
      const FirstLabels whole = first_labels(map, update.clearance_m(), skeleton, kPiece_m);
      RC_ASSERT(first.pieces == whole.pieces);
      RC_ASSERT(first.labels == whole.labels);
      RC_ASSERT(first.slopes == whole.slopes);
      RC_ASSERT(first.runs == whole.runs);
    }
  }));
}

TEST(FirstLabels, AreThoseOfThePiecesOnTheAxis) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = rooms();
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const FirstLabels first = first_labels(map, clearance_m, skeletonise(map, clearance_m), kPiece_m);
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

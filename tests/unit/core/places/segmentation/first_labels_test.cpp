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

constexpr double kPiece_m = 0.4;

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
    first = first_labels(map, update.clearance_m(), skeletonise(map, update.clearance_m()), kPiece_m);
  }

  DenseMap map = rooms();
  grid::ClearanceUpdate update;
  FirstLabels first;
};

TEST(FirstLabels, OfAMapThatChangedAreThoseOfTheWholeMap) {
  EXPECT_TRUE(rc::check([] {
    Changing now;
    auto& [map, update, first] = now;
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
      RC_ASSERT(first.axis_pieces == whole.axis_pieces);
      RC_ASSERT(first.run_pieces == whole.run_pieces);
    }
  }));
}

/// The cells that are not the same on both, of the first labels as far as they tell.
std::vector<std::uint32_t> other_cells(const FirstLabels& a, const std::vector<float>& a_m,
                                       const FirstLabels& b, const std::vector<float>& b_m) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < a.labels.size(); ++i)
    if (a.labels[i] != b.labels[i] || a_m[i] != b_m[i] || a.slopes[i] != b.slopes[i]) others.push_back(i);
  return others;
}

TEST(FirstLabels, SayWhatHasChanged) {
  EXPECT_TRUE(rc::check([] {
    Changing now;
    auto& [map, update, first] = now;
    RC_ASSERT(!first.change);
    for (int step = 0; step < 4; ++step) {
      const FirstLabels before = first;
      const std::vector<float> before_m = update.clearance_m();
      draw_patches(map, *rc::gen::inRange(0, 3), *rc::gen::element(2, 8, 20));
      update.take(map);
      relabel(map, update.clearance_m(), skeletonise(map, update.clearance_m()), kPiece_m, *update.changed(),
              first);
      const LabelChange& change = *first.change;
      for (const std::uint32_t i : other_cells(before, before_m, first, update.clearance_m())) {
        RC_ASSERT(std::any_of(change.cells.begin(), change.cells.end(),
                              [i](const grid::CellRun& run) { return run.first <= i && i < run.end; }));
        for (const std::uint32_t label : {before.labels[i], first.labels[i]})
          RC_ASSERT(label == 0 || std::binary_search(change.pieces.begin(), change.pieces.end(), label));
      }
    }
  }));
}

TEST(FirstLabels, OfAxisAndRunsAreThoseOfTheirPieces) {
  EXPECT_TRUE(rc::check([] {
    const DenseMap map = rooms();
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    const FirstLabels first = first_labels(map, clearance_m, skeletonise(map, clearance_m), kPiece_m);
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

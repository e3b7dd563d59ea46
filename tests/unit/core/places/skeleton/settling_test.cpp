// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/settling.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "core/places/skeleton/erosion.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::CellState;

/// Three strips of rows high, with what erosion makes of it.
struct Settled {
  Settled() {
    draw_patches(map, *rc::gen::inRange(0, 30), 20);
    clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    erosion = erode(map, clearance_m);
    for (std::uint32_t i = 0; i < map.cells.size(); ++i)
      if (map.cells[i] == CellState::kFree) free.push_back(i);
  }
  grid::DenseMap map = DrawnMap(40, 80).free(2, 2, 38, 78).map();
  std::vector<float> clearance_m;
  Erosion erosion;
  std::vector<std::uint32_t> free;
};

TEST(Settling, StatesThatFitTogetherStayWhenDoubted) {
  EXPECT_TRUE(rc::check([] {
    const Settled done;
    std::vector<ThinningState> states = done.erosion.states;
    Settling settling(done.map, states);
    for (const std::uint32_t i : done.free)
      if (*rc::gen::inRange(0, 3) == 0) settling.doubt(i);
    settling.settle_all();
    RC_ASSERT(states == done.erosion.states);
  }));
}

TEST(Settling, EndsTheSameWhateverWasAssumed) {
  EXPECT_TRUE(rc::check([] {
    const Settled done;
    std::vector<ThinningState> states = done.erosion.states;
    const auto assumed = *rc::gen::element<ThinningState>(0, Erosion::kKept, Erosion::kDelayed, kOutcome);
    for (const std::uint32_t i : done.free)
      if (*rc::gen::inRange(0, 2) == 0)
        states[i] = static_cast<ThinningState>((states[i] & ~kOutcome) | assumed);
    Settling settling(done.map, states);
    for (auto i = done.free.rbegin(); i != done.free.rend(); ++i) settling.doubt(*i);
    settling.settle_all();
    RC_ASSERT(states == done.erosion.states);
  }));
}

TEST(Settling, ADoubtIsNotedOnceAndGoneAfterwards) {
  EXPECT_TRUE(rc::check([] {
    const Settled done;
    RC_PRE(!done.free.empty());
    std::vector<ThinningState> states = done.erosion.states;
    Settling settling(done.map, states);
    const std::uint32_t i = *rc::gen::elementOf(done.free);
    RC_ASSERT(!settling.is_in_doubt(i));
    settling.doubt(i);
    settling.doubt(i);
    RC_ASSERT(settling.is_in_doubt(i));
    settling.settle_all();
    for (const std::uint32_t j : done.free) RC_ASSERT(!settling.is_in_doubt(j));
  }));
}

}  // namespace
}  // namespace topo::places

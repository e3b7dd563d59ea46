// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/skeleton/first_states.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "core/places/skeleton/erosion.hpp"
#include "core/places/skeleton/simple_cell.hpp"
#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::CellState;

TEST(ThinningStates, AreInEighthsOfACellAndOneFromFarOn) {
  const grid::DenseMap map = DrawnMap(3, 3, 0.1).map();
  const float per_m = buckets_per_m(map);
  EXPECT_EQ(bucket_of(state_of(0.1F, per_m)), 8U);
  EXPECT_EQ(bucket_of(state_of(0.249F, per_m)), 19U);
  EXPECT_EQ(bucket_of(state_of(51.0F, per_m)), 4080U);
  EXPECT_EQ(bucket_of(state_of(60.0F, per_m)), kBuckets - 1);
  EXPECT_EQ(bucket_of(state_of(1e9F, per_m)), kBuckets - 1);
  EXPECT_EQ(state_of(0.249F, per_m) & kFlags, 0);
}

TEST(ThinningStates, ARidgeIsWhereNoNeighbourIsMuchClearer) {
  // On a slope clearance rises by a cell a cell, in a corner by 0.71, in a corridor not at all.
  EXPECT_FALSE(is_ridge(0.5F, 0.55F, 0.55F, 0.05F));
  EXPECT_FALSE(is_ridge(0.5F, 0.5F, 0.5707F, 0.05F)) << "askew";
  EXPECT_TRUE(is_ridge(0.5F, 0.535F, 0.55F, 0.05F));
  EXPECT_TRUE(is_ridge(0.5F, 0.5F, 0.5F, 0.05F));
  EXPECT_FALSE(is_ridge(0.1F, 0.12F, 0.1F, 0.05F)) << "beside a wall";
  EXPECT_TRUE(is_ridge(0.1F, 0.11F, 0.1F, 0.05F));
}

TEST(FirstStates, DoubtWhatIsOnTheRidgeOrNotSimpleAtItsTurn) {
  EXPECT_TRUE(rc::check([] {
    grid::DenseMap map = DrawnMap(*rc::gen::inRange(5, 150), *rc::gen::inRange(5, 40)).map();
    draw_patches(map, *rc::gen::inRange(0, 20), 30);
    const auto clearance_m = grid::clearance_m(map, grid::Boundary::kOccupiedOrUnknown);
    std::vector<ThinningState> states(map.cells.size(), 0);
    const auto doubtful = assume_states(map, clearance_m, states);
    RC_ASSERT(std::ranges::is_sorted(doubtful));
    const auto offsets = neighbour_offsets(map);
    for (std::uint32_t i = 0; i < map.cells.size(); ++i) {
      const bool is_doubtful = std::ranges::binary_search(doubtful, i);
      if (map.cells[i] != CellState::kFree) {
        RC_ASSERT(states[i] == 0 && !is_doubtful);
        continue;
      }
      const auto bucket_at = [&](std::uint32_t j) {
        return map.cells[j] == CellState::kFree ? bucket_of(state_of(clearance_m[j], buckets_per_m(map))) : 0;
      };
      RC_ASSERT(bucket_of(states[i]) == bucket_at(i));
      unsigned later = 0;
      float side_m = 0.0F, corner_m = 0.0F;
      for (std::size_t k = 0; k < 8; ++k) {
        const auto j = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(i) + offsets[k]);
        if (std::pair(bucket_at(j), j) > std::pair(bucket_at(i), i)) later |= 1U << k;
        float& most_m = k % 2 == 0 ? side_m : corner_m;
        most_m = std::max(most_m, clearance_m[j]);
      }
      const bool ridge = is_ridge(clearance_m[i], side_m, corner_m, static_cast<float>(map.resolution_m));
      RC_ASSERT((states[i] & kFlags) == (ridge ? Erosion::kRidge : 0));
      RC_ASSERT(is_doubtful == (ridge || !is_simple(later)));
    }
  }));
}

}  // namespace
}  // namespace topo::places

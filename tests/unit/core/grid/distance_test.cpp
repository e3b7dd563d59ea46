// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/grid/distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/core/grid/maps.hpp"

namespace topo::grid {
namespace {

bool is_boundary(CellState state, Boundary boundary) {
  return state == CellState::kOccupied ||
         (state == CellState::kUnknown && boundary == Boundary::kOccupiedOrUnknown);
}

/// One ring around the array stands for everything outside: nothing beyond it is nearer.
float brute_force(const DenseMap& map, CellIndex from, Boundary boundary) {
  double best = HUGE_VAL;
  for (int y = map.box.min.y - 1; y <= map.box.max.y + 1; ++y) {
    for (int x = map.box.min.x - 1; x <= map.box.max.x + 1; ++x) {
      if (is_boundary(map.state({x, y}), boundary)) best = std::min(best, std::hypot(x - from.x, y - from.y));
    }
  }
  return static_cast<float>(best * map.resolution_m);
}

void expect_exact(const DenseMap& map, Boundary boundary) {
  const std::vector<float> clearance = clearance_m(map, boundary);
  ASSERT_EQ(clearance.size(), map.cells.size());
  for (std::size_t i = 0; i < clearance.size(); ++i) {
    const float expected = brute_force(map, map.cell(i), boundary);
    if (std::isinf(expected)) {
      ASSERT_TRUE(std::isinf(clearance[i])) << i;
    } else {
      ASSERT_NEAR(clearance[i], expected, 1e-5F * (1.0F + expected)) << "cell " << i;
    }
  }
}

TEST(Distance, IsTheBruteForceDistanceOnRandomMaps) {
  EXPECT_TRUE(rc::check("exact", [] {
    const DenseMap map = random_map(48);
    expect_exact(map, Boundary::kOccupied);
    expect_exact(map, Boundary::kOccupiedOrUnknown);
    RC_ASSERT(!::testing::Test::HasFailure());
  }));
}

TEST(Distance, IsExactOnUniformMaps) {
  for (const auto state : {CellState::kFree, CellState::kOccupied, CellState::kUnknown}) {
    for (const auto boundary : {Boundary::kOccupied, Boundary::kOccupiedOrUnknown}) {
      expect_exact(filled_map(33, 9, state), boundary);
      expect_exact(filled_map(1, 1, state), boundary);
    }
  }
}

/// Far from all walls, near them, and between, where another way of looking begins.
TEST(Distance, IsExactInAHallWithPillars) {
  DenseMap map = filled_map(420, 370, CellState::kFree);
  std::vector<CellIndex> pillars;
  for (const auto& [boundary, pillar] : {std::pair(Boundary::kOccupiedOrUnknown, CellIndex{30, 185}),
                                         {Boundary::kOccupied, {60, 50}},
                                         {Boundary::kOccupiedOrUnknown, {300, 200}}}) {
    pillars.push_back(pillar);
    map.cells[map.index(pillar)] = CellState::kOccupied;
    const std::vector<float> clearance = clearance_m(map, boundary);
    for (std::size_t i = 0; i < clearance.size(); ++i) {
      const CellIndex c = map.cell(i);
      double expected = HUGE_VAL;
      for (const CellIndex p : pillars) expected = std::min(expected, std::hypot(p.x - c.x, p.y - c.y));
      if (boundary == Boundary::kOccupiedOrUnknown)
        expected = std::min<double>(expected, std::min({c.x + 1, 420 - c.x, c.y + 1, 370 - c.y}));
      ASSERT_NEAR(clearance[i], expected * map.resolution_m, 1e-5 * (1.0 + expected)) << c.x << ' ' << c.y;
    }
  }
}

TEST(Distance, OfNothingIsNothing) {
  EXPECT_TRUE(clearance_m(DenseMap{}, Boundary::kOccupied).empty());
  EXPECT_TRUE(clearance_m(DenseMap{}, Boundary::kOccupiedOrUnknown).empty());
}

TEST(Distance, OutsideTheArrayIsBoundaryOnlyWhenUnknownIs) {
  expect_exact(drawn_map({"....", "....", "...."}), Boundary::kOccupiedOrUnknown);
  expect_exact(drawn_map({"...#", "....", "...."}), Boundary::kOccupied);
  expect_exact(drawn_map({"."}), Boundary::kOccupied);
}

TEST(Distance, OfOneOccupiedCellInAWideMapFitsTheNumbers) {
  DenseMap map;
  map.box = {{0, 0}, {kMaxSide - 1, 1}};
  map.cells.assign(2 * std::size_t{kMaxSide}, CellState::kFree);
  map.cells[0] = CellState::kOccupied;
  const std::vector<float> clearance = clearance_m(map, Boundary::kOccupied);
  EXPECT_NEAR(clearance[kMaxSide - 1], (kMaxSide - 1) * 0.05, 0.01);
  EXPECT_NEAR(clearance[1000 + std::size_t{kMaxSide}], std::hypot(1000.0, 1.0) * 0.05, 1e-3);
}

}  // namespace
}  // namespace topo::grid

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/box_counts.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "tests/unit/core/places/drawn_map.hpp"
#include "tests/unit/core/places/patches.hpp"

namespace topo::places {
namespace {

using grid::CellState;
using types::Vector2;

Vector2 any_point() { return {0.01 * *rc::gen::inRange(-900, 900), 0.01 * *rc::gen::inRange(-900, 900)}; }

TEST(CompassFrame, ThereAndBackIsTheSamePoint) {
  EXPECT_TRUE(rc::check([] {
    const CompassFrame frame(0.001 * *rc::gen::inRange(-4000, 4000));
    const Vector2 p = any_point(), q = any_point();
    RC_ASSERT((frame.to_map(frame.from_map(p)) - p).norm() < 1e-9);
    RC_ASSERT(std::abs((frame.from_map(p) - frame.from_map(q)).norm() - (p - q).norm()) < 1e-9);
  }));
}

TEST(CompassFrame, ItsEastIsTheCompassDirection) {
  for (const double compass_rad : {0.0, 0.4, 1.2, -0.7}) {
    const CompassFrame frame(compass_rad);
    EXPECT_NEAR((frame.to_map({1.0, 0.0}) - Vector2(std::cos(compass_rad), std::sin(compass_rad))).norm(),
                0.0, 1e-12);
    const Vector2 north = frame.to_map({0.0, 1.0});
    EXPECT_NEAR(std::atan2(north.y(), north.x()), compass_rad + 0.5 * std::numbers::pi, 1e-12);
  }
}

/// A map with patches, and boxes in a frame turned anyhow.
struct Counted {
  Counted() { draw_patches(map, *rc::gen::inRange(1, 12), 30); }
  [[nodiscard]] std::uint32_t count_within(const types::Rectangle& box) const {
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
      const bool within = box.contains(frame.from_map(map.centre_of(map.cell(i))));
      count += map.cells[i] == CellState::kOccupied && within ? 1U : 0U;
    }
    return count;
  }

  grid::DenseMap map = DrawnMap(*rc::gen::inRange(2, 90), *rc::gen::inRange(2, 60)).map();
  CompassFrame frame{0.01 * *rc::gen::inRange(-78, 79)};
};

types::Rectangle grown(types::Rectangle box, double by_m) {
  box.min -= Vector2(by_m, by_m);
  box.max += Vector2(by_m, by_m);
  return box;
}

TEST(BoxCounts, AreRightToABinAtTheSides) {
  EXPECT_TRUE(rc::check([] {
    const Counted of;
    const BoxCounts counts(of.map, of.frame);
    types::Rectangle box;
    box.extend(0.5 * any_point());
    box.extend(0.5 * any_point());
    // Bins are 0.1 m wide: a side is rounded by up to half of that.
    const std::uint32_t found = counts.occupied_in(box);
    RC_ASSERT(found <= of.count_within(grown(box, 0.051)));
    const types::Rectangle inner = grown(box, -0.051);
    if (!inner.empty()) RC_ASSERT(found >= of.count_within(inner));
  }));
}

TEST(BoxCounts, OfTwoHalvesAreThatOfTheWhole) {
  EXPECT_TRUE(rc::check([] {
    const Counted of;
    const BoxCounts counts(of.map, of.frame);
    types::Rectangle box;
    box.extend(0.5 * any_point());
    box.extend(0.5 * any_point());
    const double share = 0.01 * *rc::gen::inRange(0, 101);
    types::Rectangle left = box, right = box, low = box, high = box;
    left.max.x() = right.min.x() = box.min.x() + share * (box.max.x() - box.min.x());
    low.max.y() = high.min.y() = box.min.y() + share * (box.max.y() - box.min.y());
    const std::uint32_t all = counts.occupied_in(box);
    RC_ASSERT(counts.occupied_in(left) + counts.occupied_in(right) == all);
    RC_ASSERT(counts.occupied_in(low) + counts.occupied_in(high) == all);
  }));
}

TEST(BoxCounts, OfNoMapAreNone) {
  EXPECT_EQ(BoxCounts(grid::DenseMap{}, CompassFrame(0.3)).occupied_in({{-9.0, -9.0}, {9.0, 9.0}}), 0U);
}

}  // namespace
}  // namespace topo::places

// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/places/segmentation/wall_sides.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "tests/unit/core/places/drawn_map.hpp"

namespace topo::places {
namespace {

using grid::DenseMap;
using types::Segment;

/// Patches of some labels, and of none.
std::vector<std::uint32_t> draw_labels(const DenseMap& map) {
  std::vector<std::uint32_t> labels(map.cells.size(), 0);
  for (int count = 30; count > 0; --count) {
    const int x0 = *rc::gen::inRange(0, map.width() - 2), y0 = *rc::gen::inRange(0, map.height() - 2);
    const int x1 = std::min(map.width() - 2, x0 + *rc::gen::inRange(1, 40)),
              y1 = std::min(map.height() - 2, y0 + *rc::gen::inRange(1, 40));
    const auto label = *rc::gen::inRange<std::uint32_t>(0, 5);
    for (int y = y0; y < y1; ++y) std::fill(&labels[map.index({x0, y})], &labels[map.index({x1, y})], label);
  }
  return labels;
}

std::vector<Segment> draw_walls(int count) {
  const auto at = [] {
    return types::Vector2(0.05 * *rc::gen::inRange(-20, 240), 0.05 * *rc::gen::inRange(-20, 170));
  };
  std::vector<Segment> walls;
  for (; count > 0; --count) {
    const types::Vector2 a = at(), b = at();
    walls.push_back({a, *rc::gen::element(b, types::Vector2(a.x(), b.y()), types::Vector2(b.x(), a.y()))});
  }
  return walls;
}

TEST(WallSides, OfAllWallsAreThoseOfEachInTurn) {
  EXPECT_TRUE(rc::check([] {
    const DrawnMap drawn(220, 150);
    const std::vector<std::uint32_t> labels = draw_labels(drawn.map());
    const std::vector<Segment> walls = draw_walls(*rc::gen::inRange(0, 20));
    std::vector<WallBetween> expected;
    for (const Segment& wall : walls) {
      const auto of_one = wall_sides(drawn.map(), labels, std::span(&wall, 1), {});
      expected.insert(expected.end(), of_one.begin(), of_one.end());
    }
    RC_ASSERT(wall_sides(drawn.map(), labels, walls, {}) == expected);
  }));
}

TEST(WallSides, OfAWallTurnedRoundAreExchanged) {
  EXPECT_TRUE(rc::check([] {
    const DrawnMap drawn(220, 150);
    const std::vector<std::uint32_t> labels = draw_labels(drawn.map());
    for (const Segment& wall : draw_walls(10)) {
      std::vector<WallBetween> back =
          wall_sides(drawn.map(), labels, std::vector<Segment>{{wall.b, wall.a}}, {});
      std::reverse(back.begin(), back.end());
      for (WallBetween& sides : back) std::swap(sides.a, sides.b);
      RC_ASSERT(wall_sides(drawn.map(), labels, std::vector<Segment>{wall}, {}) == back);
    }
  }));
}

TEST(WallSides, AreWhatLiesAcrossAWall) {
  const DrawnMap drawn(100, 100);
  std::vector<std::uint32_t> labels(drawn.map().cells.size(), 0);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      if (x < 48 || x >= 52 || y >= 60) labels[drawn.map().index({x, y})] = x < 48 ? 7 : y < 60 ? 9 : 11;
    }
  }
  const auto sides = wall_sides(drawn.map(), labels,
                                std::vector<Segment>{{{2.5, 0.0}, {2.5, 2.0}},
                                                     {{3.5, 1.0}, {3.5, 1.5}},
                                                     {{1.0, 1.0}, {1.0, 1.0}},
                                                     {{NAN, 0.0}, {1.0, 1.0}}},
                                {});
  // Twenty steps of wall between two labels, and five where there is the same label on both sides.
  EXPECT_EQ(sides, (std::vector<WallBetween>{{7, 9, 20}, {9, 9, 5}}));
  EXPECT_NEAR(wall_length_m(20, 0.1), 2.0, 1e-5);
}

}  // namespace
}  // namespace topo::places

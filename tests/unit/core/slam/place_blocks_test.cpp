// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/slam/place_blocks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/unit/core/slam/matching_fixture.hpp"

namespace topo::slam {
namespace {

TEST(PlaceBlocks, ScoresAreThePyramidsSumsInsideAtTheBorderAndOutside) {
  std::mt19937 random(3);
  const SurfelMap map = testing::map_of(mocks::two_rooms(), {{3.0, 3.0, 0.0}}, 0.0, random);
  const LikelihoodPyramid pyramid(map, {0.2, 0.3, 100, 3});
  for (const int level : {0, 3}) {
    const PlaceBlocks blocks(pyramid, level);
    EXPECT_TRUE(rc::check("64 squares, one by one", [&] {
      const int x = *rc::gen::inRange(-100, 400), y = *rc::gen::inRange(-100, 400);
      std::vector<CellOffset> points;
      for (std::size_t i = 0; i < PlaceBlocks::kPoints; ++i)
        points.push_back({static_cast<int>(random() % 200) - 100, static_cast<int>(random() % 200) - 100});
      const PlaceBlocks::Scores scores = blocks.score(points, x, y);
      for (int i = 0; i < 64; ++i) {
        const int dx = i % 8 << level, dy = i / 8 << level;
        int sum = 0;
        for (const CellOffset& p : points) sum += pyramid.at(level, p.x + x + dx, p.y + y + dy);
        RC_ASSERT(scores[static_cast<std::size_t>(i)] == sum);
      }
    }));
  }
}

TEST(PlaceBlocks, AsManyPointsAsAreAllowedDoNotOverflow) {
  SurfelMap map(0.35);
  map.reset(Point::Zero(), 5.0);
  map.add(std::vector<Surfel>{{Point(0.05F, 0.05F), Point::UnitX(), true}}, {});
  const LikelihoodPyramid pyramid(map, {0.1, 0.1, 100, 0});
  const int at = static_cast<int>((0.05F - map.origin().x()) / 0.1F);
  ASSERT_GT(pyramid.at(0, at, at), 240);
  const std::vector<CellOffset> points(PlaceBlocks::kPoints, CellOffset{0, 0});
  EXPECT_EQ(PlaceBlocks(pyramid, 0).score(points, at, at).front(), pyramid.at(0, at, at) * 250);
}

}  // namespace
}  // namespace topo::slam
